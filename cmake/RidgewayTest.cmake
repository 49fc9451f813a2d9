# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# ridgeway_test(<name> [COMPUTES|LIGHT] [SOURCES <file>...] [DEPENDS <target>...] [DEFINITIONS <definition>...])
#
# One test executable, <name>_tests, its cases registered with ctest. Skipped without sources. What is
# tested is optimised; of the tests' own code that would cost a minute of a first build, so it is only
# where that code computes for long (brute force): COMPUTES. LIGHT is code that is expectations for the
# most part: it has RIDGEWAY_LIGHT_OPTIONS.
# Tests find the files of data/ by the macro RIDGEWAY_DATA_DIR.
function(ridgeway_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "COMPUTES;LIGHT" "" "SOURCES;DEPENDS;DEFINITIONS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "ridgeway_test(${name}): what is '${arg_UNPARSED_ARGUMENTS}'?")
  endif()
  if(NOT arg_SOURCES)
    message(STATUS "ridgeway: no ${name} tests yet, skipped")
    return()
  endif()
  add_executable(${name}_tests ${arg_SOURCES})
  ridgeway_target_defaults(${name}_tests)
  set_target_properties(${name}_tests PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  # Behind a precompiled header g++ 12 warns of sums of constant texts and of macros' branches, which
  # it passes over in headers of the system.
  target_compile_options(
    ${name}_tests PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-dangling-else>)
  set(group computing_tests)
  if(arg_LIGHT AND RIDGEWAY_LIGHT_OPTIONS)
    set(group light_tests)
    set(level ${RIDGEWAY_LIGHT_OPTIONS})
  elseif(NOT arg_COMPUTES)
    set(group tests)
    set(level $<$<CONFIG:Release>:-Og>)
  endif()
  target_compile_options(${name}_tests PRIVATE ${level})
  ridgeway_precompile(
    ${name}_tests ${group} HEADERS ${ridgeway_common_headers} <gtest/gtest.h> DEPENDS Eigen3::Eigen TBB::tbb GTest::gtest)
  target_compile_options(ridgeway_precompiled_${group} PRIVATE ${level})
  target_include_directories(${name}_tests PRIVATE "${PROJECT_SOURCE_DIR}/tests"
                                                    "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${name}_tests PRIVATE ${arg_DEPENDS} GTest::gtest_main)
  target_compile_definitions(
    ${name}_tests PRIVATE RIDGEWAY_DATA_DIR="${PROJECT_SOURCE_DIR}/data"
                          RIDGEWAY_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ${arg_DEFINITIONS})
  gtest_discover_tests(
    ${name}_tests
    NO_PRETTY_VALUES
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 120
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
    PROPERTIES TIMEOUT 900 LABELS ${name})
endfunction()
