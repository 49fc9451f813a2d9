# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# libridgeway.so: what the static libraries hold, the same objects, in one shared library, for who
# ships several programs or plugins. Component `shared` of find_package(ridgeway).

# ridgeway_shared_library(<component>...): of these components' modules.
function(ridgeway_shared_library)
  add_library(ridgeway_shared SHARED)
  add_library(ridgeway::shared ALIAS ridgeway_shared)
  foreach(component IN LISTS ARGN)
    get_property(modules GLOBAL PROPERTY RIDGEWAY_MODULES_${component})
    foreach(module IN LISTS modules)
      get_target_property(type ${module} TYPE)
      if(type STREQUAL "STATIC_LIBRARY")
        target_sources(ridgeway_shared PRIVATE $<TARGET_OBJECTS:${module}>)
      endif()
      target_link_libraries(ridgeway_shared PRIVATE ${module})  # for what they need
    endforeach()
  endforeach()
  # Before 1.0 a minor version may break its users.
  set_target_properties(
    ridgeway_shared
    PROPERTIES EXPORT_NAME shared
               LINKER_LANGUAGE CXX
               OUTPUT_NAME ridgeway
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
               VERSION ${PROJECT_VERSION})
  target_compile_features(ridgeway_shared INTERFACE cxx_std_20)
  target_include_directories(ridgeway_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(ridgeway_shared INTERFACE Eigen3::Eigen TBB::tbb)
endfunction()
