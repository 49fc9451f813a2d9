# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# What holds for every target of our own. Users of the installed library inherit none of it.

if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  # Sources of a folder are compiled a few at a time, so that what they include and instantiate is
  # compiled once for all of them: half of the work otherwise. So no two sources of a folder may
  # give the same name to different things, in unnamed namespaces either. OFF compiles each by itself.
  # Presets that are built as a whole (sanitizers) take all of a folder at once, a quarter less work
  # again.
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set(CMAKE_UNITY_BUILD ON)
    set(RIDGEWAY_UNITY_BATCH 7 CACHE STRING "Sources of a folder that are compiled at a time")
    set(CMAKE_UNITY_BUILD_BATCH_SIZE ${RIDGEWAY_UNITY_BATCH})
  endif()
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
                      # Sources that are compiled as one see file-level names of one another.
                      $<$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-shadow>
                      $<$<BOOL:${RIDGEWAY_WERROR}>:-Werror>)
endfunction()

# ridgeway_precompile(<target> <name> HEADERS <header>... [DEPENDS <target>...])
#
# Compiles headers of the standard library and of other projects once for all targets that give the
# same name; they are three quarters of the work otherwise. Sources include what they use all the
# same: CMAKE_DISABLE_PRECOMPILE_HEADERS=ON must build too.
function(ridgeway_precompile target name)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "HEADERS;DEPENDS")
  set(precompiled ridgeway_precompiled_${name})
  if(NOT TARGET ${precompiled})
    set(source "${PROJECT_BINARY_DIR}/precompiled_${name}.cpp")
    file(GENERATE OUTPUT "${source}" CONTENT "// Only its precompiled header is of use.\n")
    add_library(${precompiled} OBJECT EXCLUDE_FROM_ALL "${source}")
    ridgeway_target_defaults(${precompiled})
    get_target_property(independent ${target} POSITION_INDEPENDENT_CODE)
    set_target_properties(${precompiled} PROPERTIES POSITION_INDEPENDENT_CODE ${independent})
    target_link_libraries(${precompiled} PRIVATE ${arg_DEPENDS})
    target_precompile_headers(${precompiled} PRIVATE ${arg_HEADERS})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${precompiled})
endfunction()

# What most of our sources include.
set(ridgeway_common_headers
    <algorithm>
    <array>
    <atomic>
    <cmath>
    <cstdint>
    <cstring>
    <filesystem>
    <functional>
    <limits>
    <map>
    <memory>
    <numeric>
    <optional>
    <queue>
    <span>
    <string>
    <string_view>
    <unordered_map>
    <utility>
    <vector>
    <Eigen/Core>
    <Eigen/Geometry>
    <tbb/parallel_for.h>
    <tbb/task_arena.h>)
