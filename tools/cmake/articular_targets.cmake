# The one place that says how a target of this project is made: C++20, include paths from the root
# ("fem/material/material.hpp"), warnings as errors on our own code only.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

option(ARTICULAR_WERROR "Treat warnings in our own code as errors" ON)
option(ARTICULAR_SLOW_TESTS "Build and run the tests labelled slow (a minute each with sanitizers) and render (graphics drivers leak)" ON)

function(articular_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion
    $<$<BOOL:${ARTICULAR_WERROR}>:-Werror>
    # g++ 12 sees overlapping memory in "text" + std::string (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    # g++ takes a source within a unity file for a header, whose types should not be its own.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>
    # g++ does not count it as a conversion that matters.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()

# articular_library(name SOURCES ... [PUBLIC libs...] [PRIVATE libs...])
function(articular_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(articular_${name} STATIC ${arg_SOURCES})
  add_library(articular::${name} ALIAS articular_${name})
  set_target_properties(articular_${name} PROPERTIES EXPORT_NAME ${name})
  articular_settings(articular_${name})
  target_include_directories(articular_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/articular>)
  target_link_libraries(articular_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# articular_test(name SOURCES ... LIBRARIES ... [LABELS ...] [IN_ONE_PROCESS]): one GoogleTest program, each of its tests
# a ctest, or all of them one.
function(articular_test name)
  cmake_parse_arguments(arg "IN_ONE_PROCESS" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT ARTICULAR_SLOW_TESTS AND arg_LABELS MATCHES "slow|render")
    return()
  endif()
  add_executable(${name} ${arg_SOURCES})
  articular_settings(${name})
  # Time goes into the libraries, which are optimised: tests are compiled twice as fast with less of it.
  # g++ then sees uninitialised memory in Eigen where there is none.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gtest_main)
  include(GoogleTest)
  set(properties TIMEOUT 600)
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  if(arg_IN_ONE_PROCESS)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES ${properties})
  else()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
  endif()
endfunction()

# articular_starts_the_program(TARGET...): tests that start `articular` and read what lies in this tree. Those that are
# not built (slow ones, with sanitizers) are left out.
function(articular_starts_the_program)
  foreach(target ${ARGN})
    if(TARGET ${target})
      target_compile_definitions(${target} PRIVATE
        ARTICULAR_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ARTICULAR_PROGRAM="$<TARGET_FILE:articular>")
      add_dependencies(${target} articular)
    endif()
  endforeach()
endfunction()

# articular_install(name): the library and the headers of this folder, as component and package of their
# own: articular-<name>, with tools/cmake/articular-<name>-config.cmake for what it needs. Headers that
# only sources include (*.inl.hpp, simd_*.hpp) stay at home.
function(articular_install name)
  set(package articular-${name})
  set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/${package})
  set(version_file ${CMAKE_CURRENT_BINARY_DIR}/${package}-config-version.cmake)
  write_basic_package_version_file(${version_file} COMPATIBILITY SameMinorVersion)
  install(TARGETS articular_${name} EXPORT ${package} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name})
  install(EXPORT ${package} NAMESPACE articular:: FILE ${package}-targets.cmake
    DESTINATION ${cmake_folder} COMPONENT ${name})
  install(FILES ${PROJECT_SOURCE_DIR}/tools/cmake/${package}-config.cmake ${version_file}
    DESTINATION ${cmake_folder} COMPONENT ${name})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/articular/${name}
    COMPONENT ${name} FILES_MATCHING PATTERN *.hpp PATTERN *.inl.hpp EXCLUDE PATTERN simd_*.hpp EXCLUDE)
endfunction()
