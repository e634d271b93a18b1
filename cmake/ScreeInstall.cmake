include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/ScreeConfig.cmake.in ScreeConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/scree)
write_basic_package_version_file(ScreeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ScreeConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/ScreeConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/scree)
install(EXPORT scree_targets NAMESPACE scree:: FILE ScreeTargets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/scree)
