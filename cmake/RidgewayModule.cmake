# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# ridgeway_module(<name> [COMPONENT <component>] [SOURCES <file>...]
#                 [DEPENDS <target>...]
#                 [PRIVATE_DEPENDS <target>...])
#
# The library of one folder: target ridgeway_<name>, alias ridgeway::<name>. Sources are listed one
# by one, relative to src/<name>. DEPENDS are seen by users of the module's headers, PRIVATE_DEPENDS
# by its own sources alone. Without sources it is header only. COMPONENT: of find_package(ridgeway),
# `core` unless said.
function(ridgeway_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "COMPONENT" "SOURCES;DEPENDS;PRIVATE_DEPENDS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "ridgeway_module(${name}): what is '${arg_UNPARSED_ARGUMENTS}'?")
  endif()
  if(NOT arg_COMPONENT)
    set(arg_COMPONENT core)
  endif()
  set(target ridgeway_${name})

  if(arg_SOURCES)
    set(visibility PUBLIC)
    add_library(${target} STATIC ${arg_SOURCES})
    ridgeway_target_defaults(${target})
    ridgeway_precompile(${target} library HEADERS ${ridgeway_common_headers} DEPENDS Eigen3::Eigen TBB::tbb)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE_DEPENDS})
    # Headers of other modules that are not installed: "module/header.hpp".
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  else()
    set(visibility INTERFACE)
    add_library(${target} INTERFACE)
    target_compile_features(${target} INTERFACE cxx_std_20)
  endif()

  add_library(ridgeway::${name} ALIAS ${target})
  target_include_directories(
    ${target}
    ${visibility} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${visibility} ${arg_DEPENDS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY RIDGEWAY_MODULES_${arg_COMPONENT} ${target})
endfunction()
