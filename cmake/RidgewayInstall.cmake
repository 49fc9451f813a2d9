# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# Installation, find_package(ridgeway COMPONENTS ...), pkg-config, and the Debian packages ridgeway
# (the program), libridgeway0.1 (the shared library, by its version), ridgeway-dev (headers and static
# libraries), python3-ridgeway and ridgeway-doc.

include(CMakePackageConfigHelpers)
include(RidgewayShared)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ridgeway")

# Modules that need libraries of their own are components of their own; core is all others, and the
# umbrella ridgeway::ridgeway.
set(components ridge pictures sampling trajectory exploration formats recordings)
set(core_excludes)
foreach(component IN LISTS components)
  list(APPEND core_excludes PATTERN "${component}" EXCLUDE)
endforeach()
get_property(core_modules GLOBAL PROPERTY RIDGEWAY_MODULES_core)
install(
  TARGETS ${core_modules} ridgeway
  EXPORT ridgeway-core
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(EXPORT ridgeway-core NAMESPACE ridgeway:: DESTINATION "${package_dir}" COMPONENT dev)
install(
  DIRECTORY include/ridgeway "${PROJECT_BINARY_DIR}/include/ridgeway"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  COMPONENT dev
  FILES_MATCHING
  PATTERN "*.hpp" ${core_excludes})

foreach(component IN LISTS components)
  get_property(modules GLOBAL PROPERTY RIDGEWAY_MODULES_${component})
  if(modules)
    install(
      TARGETS ${modules}
      EXPORT ridgeway-${component}
      ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
    install(
      EXPORT ridgeway-${component}
      NAMESPACE ridgeway::
      DESTINATION "${package_dir}"
      COMPONENT dev)
    install(
      DIRECTORY include/ridgeway/${component}
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ridgeway"
      COMPONENT dev
      FILES_MATCHING
      PATTERN "*.hpp")
  endif()
endforeach()
set(library_package libridgeway${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if(RIDGEWAY_BUILD_SHARED)
  ridgeway_shared_library(core ${components})
  install(
    TARGETS ridgeway_shared
    EXPORT ridgeway-shared
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT dev)
  install(EXPORT ridgeway-shared NAMESPACE ridgeway:: DESTINATION "${package_dir}" COMPONENT dev)
endif()
install(
  FILES cmake/FindOMPL.cmake cmake/FindLZF.cmake
  DESTINATION "${package_dir}"
  COMPONENT dev)

configure_package_config_file(
  cmake/ridgewayConfig.cmake.in "${PROJECT_BINARY_DIR}/ridgewayConfig.cmake"
  INSTALL_DESTINATION "${package_dir}"
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/ridgewayConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/ridgewayConfig.cmake"
        "${PROJECT_BINARY_DIR}/ridgewayConfigVersion.cmake"
  DESTINATION "${package_dir}"
  COMPONENT dev)

# pkg-config: ridgeway for core, ridgeway-NAME for each other component; ridgeway-shared for all of
# them in the shared library. The others are static, so those that they need are always named, and
# libraries stand before what they use.
set(pc_needs_ridge ridgeway libzstd)
set(pc_needs_pictures ridgeway cairo)
set(pc_needs_sampling ridgeway ompl)
set(pc_needs_trajectory ridgeway nlopt)
set(pc_needs_exploration ridgeway-trajectory)
set(pc_needs_formats ridgeway-ridge ridgeway-trajectory liblzf yaml-cpp libpng)
set(pc_needs_recordings ridgeway-formats)
set(pc_needs_core eigen3 tbb)
set(pc_needs_shared eigen3 tbb)
# Where the files are, so that a tree may be installed anywhere, and moved.
set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  file(RELATIVE_PATH pc_prefix "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
  string(PREPEND pc_prefix "\${pcfiledir}/")
endif()
if(RIDGEWAY_BUILD_SHARED)
  set_property(GLOBAL PROPERTY RIDGEWAY_MODULES_shared ridgeway_shared)
endif()
foreach(component IN ITEMS core ${components} shared)
  get_property(modules GLOBAL PROPERTY RIDGEWAY_MODULES_${component})
  if(NOT modules)
    continue()
  endif()
  if(NOT DEFINED pc_needs_${component})
    message(FATAL_ERROR "what ${component} needs is not said for pkg-config")
  endif()
  set(pc_name ridgeway-${component})
  if(component STREQUAL "core")
    set(pc_name ridgeway)
  endif()
  set(pc_libraries)
  foreach(module IN LISTS modules)
    get_target_property(type ${module} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      list(PREPEND pc_libraries "-l${module}")
    elseif(type STREQUAL "SHARED_LIBRARY")
      list(PREPEND pc_libraries "-lridgeway")
    endif()
  endforeach()
  list(JOIN pc_libraries " " pc_libraries)
  list(JOIN pc_needs_${component} ", " pc_requires)
  configure_file(cmake/ridgeway.pc.in "${PROJECT_BINARY_DIR}/pkgconfig/${pc_name}.pc" @ONLY)
  install(
    FILES "${PROJECT_BINARY_DIR}/pkgconfig/${pc_name}.pc"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
    COMPONENT dev)
endforeach()

install(
  FILES README.md CHANGELOG.md
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/ridgeway-doc"
  COMPONENT doc)
install(
  DIRECTORY docs examples
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/ridgeway-doc"
  COMPONENT doc
  PATTERN "CMakeLists.txt" EXCLUDE
  PATTERN "docs/site" EXCLUDE)

# Made by ./dev docs; without it the pages are there as Markdown alone.
install(
  DIRECTORY "${PROJECT_BINARY_DIR}/site/"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/ridgeway-doc/html"
  COMPONENT doc
  OPTIONAL)

if(TARGET ridgeway_cli)
  install(TARGETS ridgeway_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime)
endif()
if(TARGET ridgeway_mesh_reader)
  install(TARGETS ridgeway_mesh_reader RUNTIME DESTINATION "${CMAKE_INSTALL_LIBEXECDIR}/ridgeway"
                                               COMPONENT runtime)
endif()
install(
  FILES LICENSE
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/ridgeway"
  RENAME copyright
  COMPONENT runtime)
install(
  FILES LICENSE
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/ridgeway-dev"
  RENAME copyright
  COMPONENT dev)
install(
  FILES LICENSE
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/ridgeway-doc"
  RENAME copyright
  COMPONENT doc)
if(TARGET ridgeway_shared)
  install(
    FILES LICENSE
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${library_package}"
    RENAME copyright
    COMPONENT library)
endif()
if(TARGET ridgeway_python)
  install(
    FILES LICENSE
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/python3-ridgeway"
    RENAME copyright
    COMPONENT python)
endif()

if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "The Ridgeway authors <ridgeway@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_COMPONENTS_ALL runtime dev doc)
  if(TARGET ridgeway_python)
    list(APPEND CPACK_COMPONENTS_ALL python)
  endif()
  if(TARGET ridgeway_shared)
    list(APPEND CPACK_COMPONENTS_ALL library)
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS ridgeway)  # which reads meshes
    set(dev_needs_library ", ${library_package} (= ${PROJECT_VERSION})")
  endif()
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ridgeway)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_DEV_PACKAGE_NAME ridgeway-dev)
  set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libtbb-dev${dev_needs_library}")
  string(
    JOIN ", " CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS
    libompl-dev
    libnlopt-dev
    pkg-config libcairo2-dev libzstd-dev liblzf-dev libpng-dev libyaml-cpp-dev
    ridgeway)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-ridgeway)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The compiled part is for one version of Python.
  math(EXPR next_python "${PYTHON_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${PYTHON_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "ridgeway")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-networkx")
  set(CPACK_DEBIAN_DOC_PACKAGE_NAME ridgeway-doc)
  set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
  set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
  include(CPack)
endif()

# All that is installed, for ./dev install: tests take as long again to build.
add_custom_target(ridgeway_installed)
foreach(component IN ITEMS core ${components} shared)
  get_property(modules GLOBAL PROPERTY RIDGEWAY_MODULES_${component})
  if(modules)
    add_dependencies(ridgeway_installed ${modules})
  endif()
endforeach()
foreach(target IN ITEMS ridgeway_cli ridgeway_mesh_reader ridgeway_manual ridgeway_python_package)
  if(TARGET ${target})
    add_dependencies(ridgeway_installed ${target})
  endif()
endforeach()
