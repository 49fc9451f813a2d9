# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# Installs the build into a fresh prefix, then configures, builds and runs the consumer project.
# Expects BINARY_DIR, SOURCE_DIR, WORK_DIR, VERSION, CXX, CXX_FLAGS, BUILD_TYPE and GENERATOR.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
run("${CMAKE_COMMAND}" --install "${BINARY_DIR}" --prefix "${WORK_DIR}/prefix")
run(
  "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" "-DCMAKE_CXX_COMPILER=${CXX}"
  "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
  "-DRIDGEWAY_VERSION=${VERSION}")
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build")
run("${WORK_DIR}/build/consumer_core" "${VERSION}")
run("${WORK_DIR}/build/consumer_trajectory")
run("${WORK_DIR}/build/consumer_ridge")
run("${WORK_DIR}/build/consumer_recordings")
run("${WORK_DIR}/build/consumer_sampling")
run("${WORK_DIR}/build/consumer_shared")

execute_process(
  COMMAND readelf --dynamic "${WORK_DIR}/build/consumer_shared"
  OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(NOT dynamic MATCHES "NEEDED[^\n]*libridgeway\\.so" OR dynamic MATCHES "NEEDED[^\n]*libyaml")
  message(FATAL_ERROR "a program of the shared library links others, too: ${dynamic}")
endif()

# A program that loads a roadmap and plans needs oneTBB and zstd (Eigen is headers alone), and what
# any C++ program needs.
execute_process(
  COMMAND readelf --dynamic "${WORK_DIR}/build/consumer_ridge"
  OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "NEEDED[^\n]*" needed "${dynamic}")
list(FILTER needed EXCLUDE REGEX "\\[(libtbb|libzstd|libstdc\\+\\+|libm|libgcc_s|libc|ld-linux[^.]*|lib[a-z]*san)\\.so")
if(needed OR NOT dynamic MATCHES "libzstd\\.so" OR NOT dynamic MATCHES "libtbb\\.so")
  message(FATAL_ERROR "a program that loads a .ridge and plans links more or less than it needs: ${needed}")
endif()

# Each component alone, as another would have looked for what it forgets to look for.
file(
  WRITE "${WORK_DIR}/alone/CMakeLists.txt"
  "cmake_minimum_required(VERSION 3.22)\n"
  "project(alone LANGUAGES CXX)\n"
  "find_package(ridgeway REQUIRED COMPONENTS \${COMPONENT})\n"
  "add_executable(alone \${SOURCE})\n"
  "target_link_libraries(alone PRIVATE ridgeway::\${COMPONENT})\n")
foreach(component IN ITEMS ridge pictures sampling trajectory exploration formats recordings shared)
  run(
    "${CMAKE_COMMAND}" -S "${WORK_DIR}/alone" -B "${WORK_DIR}/alone/${component}" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" "-DCMAKE_CXX_COMPILER=${CXX}"
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
    "-DCOMPONENT=${component}" "-DSOURCE=${SOURCE_DIR}/formats.cpp")
endforeach()
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/alone/formats")
run("${WORK_DIR}/alone/formats/alone")

# By pkg-config, from where it was installed.
find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  file(WRITE "${WORK_DIR}/explorer.cpp" "#include \"ridgeway/exploration/explorer.hpp\"\n"
       "int main() { return ridgeway::Explorer({}).frontiers().voxels() == 0 ? 0 : 1; }\n")
  file(GLOB_RECURSE pc_file "${WORK_DIR}/prefix/*/ridgeway.pc")
  get_filename_component(pc_folder "${pc_file}" DIRECTORY)
  separate_arguments(cxx_flags UNIX_COMMAND "${CXX_FLAGS}")
  foreach(package IN ITEMS ridge exploration formats)
    set(source_ridge "${SOURCE_DIR}/ridge.cpp")
    set(source_formats "${SOURCE_DIR}/formats.cpp")
    set(source_exploration "${WORK_DIR}/explorer.cpp")
    execute_process(
      COMMAND "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${pc_folder}" "${PKG_CONFIG}" --cflags
              --libs ridgeway-${package}
      OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
    separate_arguments(flags UNIX_COMMAND "${flags}")
    run("${CXX}" -std=c++20 ${cxx_flags} "${source_${package}}" -o "${WORK_DIR}/${package}" ${flags})
    run("${WORK_DIR}/${package}")
  endforeach()
endif()
