# The functions of the build: a module, a folder of a module, a test, a benchmark program.

# Linking takes gcc's own linker four times as long, most of all with sanitizers.
find_program(SCREE_LLD ld.lld)
if(SCREE_LLD)
  add_link_options(-fuse-ld=lld)
endif()

# Only libraries that are used are loaded: OpenImageIO alone brings 240 others, a quarter of a second
# at every start.
add_link_options(LINKER:--as-needed)

add_library(scree_flags INTERFACE)
target_compile_options(scree_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off
  $<$<BOOL:${SCREE_WERROR}>:-Werror>)
if(SCREE_SANITIZE)
  add_compile_options(-fsanitize=${SCREE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${SCREE_SANITIZE})
  add_compile_definitions(SCREE_SANITIZED=1)
  # Four checks take half of the compiler's time and see little that AddressSanitizer and the hardware
  # do not; the fuzzers, built by clang, keep them for what reads files.
  if(SCREE_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
  endif()
  # The checks that sanitizers weave in make gcc see uninitialised values inside OpenMesh.
  target_compile_options(scree_flags INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

# What nearly every file of a module includes, compiled once, which saves a third of the time. The
# thread sanitizer's build and `debug` go without, and so find what forgot to include what it needs.
function(scree_precompile target)
  if(SCREE_MODULE_PCH)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem>
      <functional> <limits> <memory> <numbers> <optional> <span> <sstream> <string> <string_view>
      <utility> <vector> <glm/common.hpp> <glm/geometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp> ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)  # for ccache
    # What gcc wrongly warns of inside std::string is no longer told apart as the system's.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
      $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread> $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
      $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
  endif()
endfunction()

function(scree_add_module name)
  cmake_parse_arguments(arg "" "" "HEADERS;SOURCES;PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  add_library(scree_${name} STATIC ${arg_SOURCES})
  add_library(scree::${name} ALIAS scree_${name})
  set_target_properties(scree_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(scree_${name}
    PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:scree_flags> ${arg_PRIVATE})
  target_compile_features(scree_${name} PUBLIC cxx_std_20)
  scree_precompile(scree_${name} ${arg_PRECOMPILE})
  target_sources(scree_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  install(TARGETS scree_${name} EXPORT scree_targets
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scree)
endfunction()

function(scree_add_sources name)  # called in a folder of the module, with paths relative to it
  cmake_parse_arguments(arg "" "" "HEADERS;SOURCES;PRIVATE" ${ARGN})
  list(TRANSFORM arg_HEADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(TRANSFORM arg_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  target_sources(scree_${name} PRIVATE ${arg_SOURCES})
  target_sources(scree_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  target_link_libraries(scree_${name} PRIVATE ${arg_PRIVATE})
endfunction()

# Two thirds of a build's time go into tests, so those are compiled lightly: little optimisation or,
# with sanitizers, none and no line numbers.
add_library(scree_test_flags INTERFACE)
target_compile_options(scree_test_flags INTERFACE $<$<CONFIG:Release>:-O1>)
if(SCREE_SANITIZE)
  target_compile_options(scree_test_flags INTERFACE -O0 -g0)
endif()

# tests/<path>_test.cpp. The tests of a folder share one program, <folder>_tests: linking and starting
# programs costs more than most tests do, so ctest runs a program as one test, under the name of its
# target; single ones are picked by --gtest_filter. Those with a label or a time limit of their own stand
# alone, and those that wait for other programs (cli/) are listed each, as cli/Suite.Name.
# Labels: `threads` for what TSan should see, `slow` for what the sanitizer builds leave out.
# The program's target is left in scree_test_target.
function(scree_add_test path)
  cmake_parse_arguments(arg "" "TIMEOUT" "LIBS;LABELS" ${ARGN})
  get_filename_component(folder ${path} DIRECTORY)
  if(arg_LABELS OR arg_TIMEOUT)
    string(REPLACE "/" "_" target ${path}_test)
  else()
    string(REPLACE "/" "_" target ${folder}_tests)
  endif()
  set(scree_test_target ${target} PARENT_SCOPE)
  if(NOT TARGET ${target})
    scree_add_test_program(${target} ${path} ${folder} "${arg_TIMEOUT}" "${arg_LABELS}")
  endif()
  target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/${path}_test.cpp)
  target_link_libraries(${target} PRIVATE
    ${arg_LIBS} scree_test_support scree_flags scree_test_flags GTest::gmock_main)
endfunction()

function(scree_add_test_program target path folder timeout labels)
  add_executable(${target})
  target_compile_definitions(${target} PRIVATE SCREE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(SCREE_TEST_PCH)
    target_precompile_headers(${target} REUSE_FROM scree_test_headers)
  endif()
  if(NOT timeout)
    set(timeout 300)
  endif()
  if("threads" IN_LIST labels)
    set_property(GLOBAL APPEND PROPERTY SCREE_THREADED_TESTS ${target})
  endif()
  if(folder STREQUAL "cli")
    gtest_discover_tests(${target} TEST_PREFIX ${folder}/ DISCOVERY_TIMEOUT 120
      PROPERTIES TIMEOUT ${timeout} LABELS "${labels}")
  else()
    add_test(NAME ${target} COMMAND ${target})
    set_property(TEST ${target} PROPERTY TIMEOUT 1200)
    set_property(TEST ${target} PROPERTY LABELS ${labels})
  endif()
endfunction()

function(scree_add_benchmark name)  # tests/bench/<name>_bench.cpp -> build/<preset>/tests/bench/<name>
  cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
  add_executable(bench_${name} ${PROJECT_SOURCE_DIR}/tests/bench/${name}_bench.cpp)
  set_target_properties(bench_${name} PROPERTIES OUTPUT_NAME ${name})
  target_link_libraries(bench_${name} PRIVATE
    ${arg_LIBS} scree_flags scree_test_support benchmark::benchmark_main)
  target_compile_definitions(bench_${name} PRIVATE SCREE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()
