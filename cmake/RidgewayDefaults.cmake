# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# What holds for every target of our own. Users of the installed library inherit none of it.

if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  find_program(RIDGEWAY_CCACHE ccache)
  if(RIDGEWAY_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${RIDGEWAY_CCACHE}")
  endif()
endif()

# ridgeway_target_defaults(<target>): C++20, warnings, and no fused multiply-adds, so that the
# same input gives the same output on every processor.
function(ridgeway_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(
    ${target} PROPERTIES CXX_EXTENSIONS OFF CXX_STANDARD 20 POSITION_INDEPENDENT_CODE ON)
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off
                      # Clang counts this as -Wconversion, GCC does not.
                      $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>
                      $<$<BOOL:${RIDGEWAY_WERROR}>:-Werror>)
endfunction()
