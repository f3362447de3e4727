# The one place that says how a target of this project is made: C++20, include paths from the root
# ("fem/material.hpp"), warnings as errors on our own code only.

option(ARTICULAR_WERROR "Treat warnings in our own code as errors" ON)

function(articular_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion
    $<$<BOOL:${ARTICULAR_WERROR}>:-Werror>
    # g++ 12 sees overlapping memory in "text" + std::string (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
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
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/articular>)
  target_link_libraries(articular_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# articular_test(name SOURCES ... LIBRARIES ... [LABELS ...]): one GoogleTest program, each of its tests a ctest.
function(articular_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  articular_settings(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gtest_main)
  include(GoogleTest)
  set(properties TIMEOUT 600)
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
endfunction()
