# find_package(scree) after `cmake --install`; headers are included as in the tree ("vision/outline.h").
include(CMakePackageConfigHelpers)
set(scree_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/scree)
configure_package_config_file(cmake/scree-config.cmake.in scree-config.cmake
  INSTALL_DESTINATION ${scree_cmake_dir})
write_basic_package_version_file(scree-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/scree-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/scree-config-version.cmake
              cmake/Findepoxy.cmake
        DESTINATION ${scree_cmake_dir})
install(EXPORT scree_targets NAMESPACE scree:: FILE scree-targets.cmake DESTINATION ${scree_cmake_dir})
