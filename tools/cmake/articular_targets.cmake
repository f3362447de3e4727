# The one place that says how a target of this project is made: C++20, include paths from the root
# ("fem/material/material.hpp"), warnings as errors on our own code only.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

option(ARTICULAR_WERROR "Treat warnings in our own code as errors" ON)
option(ARTICULAR_SLOW_TESTS "Build and run the tests labelled slow and render" ON)
option(ARTICULAR_SANITIZED "Build all libraries and the program a second time, with sanitizers, and run the tests with those too" OFF)
option(ARTICULAR_SANITIZED_WHOLE "With sanitizers, run the slow tests too and those that compute for long: hours" OFF)

# Half of the tests' programs hold all libraries with their sanitizers, 200 MB each, which mold links four times as fast.
find_program(ARTICULAR_MOLD mold)
mark_as_advanced(ARTICULAR_MOLD)
if(ARTICULAR_SANITIZED AND ARTICULAR_MOLD)
  add_link_options($<$<CXX_COMPILER_ID:GNU>:-fuse-ld=mold>)
endif()

# clang compiles sanitized code in two thirds of the time that g++ takes. Where both are there it stands in for g++ by a
# launcher, to which CMake hands its own compiler, which is dropped, and all arguments.
find_program(ARTICULAR_CLANG NAMES clang++-14 clang++)
mark_as_advanced(ARTICULAR_CLANG)
if(ARTICULAR_SANITIZED AND ARTICULAR_CLANG AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(sanitizing_launcher ${CMAKE_BINARY_DIR}/clang-for-another)
  list(JOIN CMAKE_CXX_COMPILER_LAUNCHER " " launcher)
  file(CONFIGURE OUTPUT ${sanitizing_launcher} CONTENT "#!/bin/sh\nshift\nexec @launcher@ '@ARTICULAR_CLANG@' \"$@\"\n" @ONLY)
  file(CHMOD ${sanitizing_launcher} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endif()

# Null pointers and what lies beyond an object are seen by the address sanitizer too. Checks of alignment at every access
# are a third of the time that sanitized code takes to compile, those of sizes and virtual tables a sixth of the rest, and
# those of sums with pointers a sixth of what is left then. Fuzzers, which clang compiles, have them all (CMakePresets.json).
set(sanitizer_options -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow -fno-sanitize-recover=all
  -fno-omit-frame-pointer)

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

# articular_module(target SOURCES ... [PUBLIC libs...] [PRIVATE libs...] [DRAWS]): a static library; with
# ARTICULAR_SANITIZED another one, <target>_sanitized, that links what is sanitized of its libraries. Of one that DRAWS
# the objects are the same, as nothing is drawn with sanitizers (graphics drivers leak).
function(articular_module target)
  cmake_parse_arguments(arg "DRAWS" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${target} STATIC ${arg_SOURCES})
  articular_settings(${target})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  if(ARTICULAR_SANITIZED)
    articular_sanitized_names(public ${arg_PUBLIC})
    articular_sanitized_names(private ${arg_PRIVATE})
    if(arg_DRAWS)
      add_library(${target}_sanitized STATIC $<TARGET_OBJECTS:${target}>)
      set_target_properties(${target}_sanitized PROPERTIES LINKER_LANGUAGE CXX)
    else()
      add_library(${target}_sanitized STATIC ${arg_SOURCES})
      articular_settings(${target}_sanitized)
      articular_sanitize(${target}_sanitized)
    endif()
    target_link_libraries(${target}_sanitized PUBLIC ${public} PRIVATE ${private})
  endif()
endfunction()

# As in Debug, with assertions, but for -O1: what is sanitized is slow enough. With the address sanitizer Eigen would align
# what it allocates by itself, and matrices pass between these objects and those of the tests.
function(articular_sanitize target)
  target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  # Warnings are for the twin without sanitizers, with the compiler that is asked for.
  target_compile_options(${target} PRIVATE -O1 -g1 -UNDEBUG ${sanitizer_options} -w)
  articular_launch_sanitizing(${target})
endfunction()

# The launcher compiles and links the target.
function(articular_launch_sanitizing target)
  if(sanitizing_launcher)
    set_target_properties(${target} PROPERTIES
      CXX_COMPILER_LAUNCHER ${sanitizing_launcher} CXX_LINKER_LAUNCHER ${sanitizing_launcher})
  endif()
endfunction()

# The names of libraries with those of ours replaced by their sanitized twins.
function(articular_sanitized_names result)
  set(names)
  foreach(library ${ARGN})
    if(TARGET ${library}_sanitized)
      set(library ${library}_sanitized)
    endif()
    list(APPEND names ${library})
  endforeach()
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# articular_library(name SOURCES ... [PUBLIC libs...] [PRIVATE libs...]): articular::name
function(articular_library name)
  articular_module(articular_${name} ${ARGN})
  set_target_properties(articular_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(articular_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/articular>)
  add_library(articular::${name} ALIAS articular_${name})
  if(ARTICULAR_SANITIZED)
    target_include_directories(articular_${name}_sanitized PUBLIC ${PROJECT_SOURCE_DIR})
    add_library(articular::${name}_sanitized ALIAS articular_${name}_sanitized)
  endif()
endfunction()

# articular_program(target SOURCES ... LIBRARIES ...): with ARTICULAR_SANITIZED another one, <target>_sanitized.
function(articular_program target)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${target} ${arg_SOURCES})
  articular_settings(${target})
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES})
  if(ARTICULAR_SANITIZED)
    articular_sanitized_names(libraries ${arg_LIBRARIES})
    add_executable(${target}_sanitized ${arg_SOURCES})
    articular_settings(${target}_sanitized)
    articular_sanitize(${target}_sanitized)
    target_link_options(${target}_sanitized PRIVATE ${sanitizer_options})
    target_link_libraries(${target}_sanitized PRIVATE ${libraries})
  endif()
endfunction()

# articular_test(name SOURCES ... LIBRARIES ... [LABELS ...] [UNSANITIZED ...] [IN_ONE_PROCESS]): one GoogleTest program,
# each of its tests a ctest, or all of them one. With ARTICULAR_SANITIZED all tests are run, and most take less time than
# the start of a process: those of a program share eight, ctests "NAME/1of8" and so on; but each slow one is a ctest.
# The same objects are then linked a second time, with the sanitized libraries, for ctests "sanitized/NAME/1of8" with
# the label "sanitized". Tests take longest to compile, and what they are to find is in the libraries. Slow ones would take
# minutes with sanitizers, and graphics drivers leak. So would those of UNSANITIZED, patterns of GoogleTest: they compute
# for long what shorter ones reach.
function(articular_test name)
  cmake_parse_arguments(arg "IN_ONE_PROCESS" "" "SOURCES;LIBRARIES;LABELS;UNSANITIZED" ${ARGN})
  if(NOT ARTICULAR_SLOW_TESTS AND arg_LABELS MATCHES "slow|render")
    return()
  endif()
  add_library(${name}_objects OBJECT ${arg_SOURCES})
  articular_settings(${name}_objects)
  # Time goes into the libraries, which are optimised: tests are compiled twice as fast with less of it.
  # g++ then sees uninitialised memory in Eigen where there is none.
  target_compile_options(${name}_objects PRIVATE $<$<CONFIG:Release>:-O1>
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
  target_include_directories(${name}_objects PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name}_objects PRIVATE ${arg_LIBRARIES} GTest::gtest_main)
  add_executable(${name} $<TARGET_OBJECTS:${name}_objects>)
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gtest_main)
  articular_register_tests(${name} "" "${arg_IN_ONE_PROCESS}" "${arg_LABELS}" "*")
  if(ARTICULAR_SANITIZED_WHOLE)
    set(not_sanitized render)
    set(arg_UNSANITIZED)
  else()
    set(not_sanitized "slow|render")
  endif()
  if(ARTICULAR_SANITIZED AND NOT arg_LABELS MATCHES "${not_sanitized}")
    articular_sanitized_names(libraries ${arg_LIBRARIES})
    add_executable(${name}_sanitized $<TARGET_OBJECTS:${name}_objects>)
    articular_launch_sanitizing(${name}_sanitized)
    target_link_libraries(${name}_sanitized PRIVATE ${libraries} GTest::gtest_main)
    # Of functions in headers, which both the tests and the libraries hold, the linker takes the first: the sanitized.
    articular_own_libraries(own ${libraries})
    target_link_options(${name}_sanitized PRIVATE ${sanitizer_options}
      LINKER:--whole-archive ${own} LINKER:--no-whole-archive)
    list(JOIN arg_UNSANITIZED ":" left_out)
    articular_register_tests(${name}_sanitized "sanitized/" "${arg_IN_ONE_PROCESS}" "${arg_LABELS};sanitized" "*-${left_out}")
  endif()
endfunction()

# The files of those libraries that are sanitized, and of what these link.
function(articular_own_libraries result)
  set(files)
  foreach(library ${ARGN})
    if(library MATCHES "_sanitized$")
      get_target_property(linked ${library} LINK_LIBRARIES)
      articular_own_libraries(more ${linked})
      list(APPEND files $<TARGET_FILE:${library}> ${more})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES files)
  set(${result} ${files} PARENT_SCOPE)
endfunction()

include(GoogleTest)
function(articular_register_tests program prefix in_one_process labels filter)
  set(properties TIMEOUT 600)
  if(prefix AND ARTICULAR_SANITIZED_WHOLE)
    set(properties TIMEOUT 7200)
  endif()
  if(labels MATCHES "slow" OR in_one_process)
    list(APPEND properties COST 100)  # first, so that at the end no processor waits for another
  endif()
  if(in_one_process)
    articular_register_processes(${program} "${prefix}" 1 "${labels}" "${filter}" ${properties})
  elseif(ARTICULAR_SANITIZED AND (prefix OR NOT labels MATCHES "slow|render"))
    articular_register_processes(${program} "${prefix}" 8 "${labels}" "${filter}" ${properties})
  else()
    if(labels)
      list(APPEND properties LABELS "${labels}")
    endif()
    gtest_discover_tests(${program} DISCOVERY_MODE PRE_TEST TEST_FILTER "${filter}" PROPERTIES ${properties})
  endif()
endfunction()

# articular_register_processes(... PROPERTY VALUE...): tests of which several share a process.
function(articular_register_processes program prefix processes labels filter)
  foreach(process RANGE 1 ${processes})
    set(name ${prefix}${program})
    if(processes GREATER 1)
      string(APPEND name "/${process}of${processes}")  # without spaces: ctest keeps no times of names that have some
    endif()
    math(EXPR index "${process} - 1")
    set(environment GTEST_TOTAL_SHARDS=${processes} GTEST_SHARD_INDEX=${index})
    if(prefix)
      list(APPEND environment "ARTICULAR_PROGRAM=$<TARGET_FILE:articular_sanitized>")
    endif()
    add_test(NAME "${name}" COMMAND ${program} --gtest_filter=${filter})
    set_tests_properties("${name}" PROPERTIES ${ARGN} LABELS "${labels}" ENVIRONMENT "${environment}")
  endforeach()
endfunction()

# articular_starts_the_program(TEST...): tests that start `articular` (tests/tools/support/program.hpp) and read what
# lies in this tree. Those that are not built (slow ones, with sanitizers) are left out.
function(articular_starts_the_program)
  foreach(test ${ARGN})
    if(TARGET ${test})
      articular_knows_the_tree(${test})
      target_compile_definitions(${test}_objects PRIVATE ARTICULAR_PROGRAM="$<TARGET_FILE:articular>")
      add_dependencies(${test} articular)
    endif()
    if(TARGET ${test}_sanitized)
      add_dependencies(${test}_sanitized articular_sanitized)
    endif()
  endforeach()
endfunction()

# articular_knows_the_tree(TEST): the test reads what lies in this tree.
function(articular_knows_the_tree test)
  target_compile_definitions(${test}_objects PRIVATE ARTICULAR_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
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
    COMPONENT ${name} FILES_MATCHING PATTERN *.hpp PATTERN *.inl.hpp EXCLUDE PATTERN simd_*.hpp EXCLUDE PATTERN figures EXCLUDE)
endfunction()
