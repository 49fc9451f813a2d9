# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# Finds OMPL by its files: the CMake file that Debian ships names Boost and ODE libraries that are
# not installed with it, and that nothing of ours needs. Defines OMPL::OMPL.
find_path(OMPL_INCLUDE_DIR ompl/config.h PATH_SUFFIXES ompl-1.5 ompl-1.6)
find_library(OMPL_LIBRARY ompl)
find_path(OMPL_BOOST_INCLUDE_DIR boost/graph/adjacency_list.hpp)
mark_as_advanced(OMPL_INCLUDE_DIR OMPL_LIBRARY OMPL_BOOST_INCLUDE_DIR)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OMPL REQUIRED_VARS OMPL_LIBRARY OMPL_INCLUDE_DIR OMPL_BOOST_INCLUDE_DIR)

if(OMPL_FOUND AND NOT TARGET OMPL::OMPL)
  add_library(OMPL::OMPL UNKNOWN IMPORTED)
  set_target_properties(
    OMPL::OMPL PROPERTIES IMPORTED_LOCATION "${OMPL_LIBRARY}"
                          INTERFACE_INCLUDE_DIRECTORIES
                          "${OMPL_INCLUDE_DIR};${OMPL_BOOST_INCLUDE_DIR}")
endif()
