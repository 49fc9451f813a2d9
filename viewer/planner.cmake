# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# The library's own planner for WebAssembly: the sources that answering the page takes, a folder at a
# time, with stand-ins for what Debian has not for it (wasm/shims: oneTBB on one thread, zstd by way
# of JavaScript; no NLopt, so trajectories stop at corners). Sets `planner`, the module it makes.
set(emxx "${CMAKE_COMMAND}" -E env NODE_PATH=/usr/share/nodejs "${EMXX_PROGRAM}")
set(wasm_folder "${CMAKE_CURRENT_BINARY_DIR}/wasm")
file(MAKE_DIRECTORY "${wasm_folder}/include")
file(CREATE_LINK /usr/include/nlohmann "${wasm_folder}/include/nlohmann" SYMBOLIC)
set(wasm_flags
    -std=c++20 -O2 -DNDEBUG -fexceptions -ffp-contract=off -Wno-everything -DRIDGEWAY_STOP_AND_GO
    "-I${CMAKE_CURRENT_SOURCE_DIR}/wasm/shims" "-I${PROJECT_SOURCE_DIR}/include"
    "-I${PROJECT_BINARY_DIR}/include" "-I${PROJECT_SOURCE_DIR}/src"
    "-I${PROJECT_SOURCE_DIR}/apps/ridgeway" -isystem/usr/include/eigen3 "-I${wasm_folder}/include"
    -include missing.hpp)

set(wasm_objects)
# wasm_objects_of(<name> <source>...): sources with full paths, compiled as one. No two may give the
# same name to different things.
function(wasm_objects_of name)
  set(sources ${ARGN})
  set(together "${wasm_folder}/${name}.cpp")
  list(TRANSFORM sources PREPEND "#include \"" OUTPUT_VARIABLE lines)
  list(TRANSFORM lines APPEND "\"\n")
  list(JOIN lines "" text)
  file(CONFIGURE OUTPUT "${together}" CONTENT "${text}" @ONLY)
  set(object "${wasm_folder}/${name}.o")
  add_custom_command(
    OUTPUT "${object}"
    COMMAND ${emxx} ${wasm_flags} -MD -MF "${object}.d" -c "${together}" -o "${object}"
    DEPENDS "${together}" ${sources}
    DEPFILE "${object}.d"
    COMMENT "Planner of the page: ${name}")
  set(wasm_objects ${wasm_objects} "${object}" PARENT_SCOPE)
endfunction()

foreach(module voxel esdf paths skeleton roadmap planning trajectory viewer)
  get_target_property(sources ridgeway_${module} SOURCES)
  list(REMOVE_ITEM sources optimise_spline.cpp live_layers.cpp)
  list(TRANSFORM sources PREPEND "${PROJECT_SOURCE_DIR}/src/${module}/")
  wasm_objects_of(${module} ${sources})
endforeach()
set(sources
    mapping/occupancy_map.cpp mapping/memory_limit.cpp mapping/normalised.cpp mapping/voxel_range.cpp
    files/atomic_file.cpp files/file_error.cpp files/read_file.cpp files/temporary.cpp
    formats/build_record.cpp formats/path_io.cpp formats/trajectory_io.cpp)
list(TRANSFORM sources PREPEND "${PROJECT_SOURCE_DIR}/src/")
wasm_objects_of(files ${sources})
set(sources ridge_checks.cpp ridge_file.cpp ridge_header.cpp ridge_lists.cpp ridge_reader.cpp
            ridge_voxels_load.cpp site_checks.cpp)
list(TRANSFORM sources PREPEND "${PROJECT_SOURCE_DIR}/src/ridge/")
wasm_objects_of(ridge ${sources})
set(sources arguments.cpp console.cpp interruption.cpp json.cpp limit_options.cpp roadmap_facts.cpp
            view/map_answers.cpp)
list(TRANSFORM sources PREPEND "${PROJECT_SOURCE_DIR}/apps/ridgeway/")
wasm_objects_of(answers ${sources})
wasm_objects_of(planner "${CMAKE_CURRENT_SOURCE_DIR}/wasm/planner.cpp"
            "${CMAKE_CURRENT_SOURCE_DIR}/wasm/optimise_spline.cpp"
            "${CMAKE_CURRENT_SOURCE_DIR}/wasm/with_progress.cpp")

set(planner "${wasm_folder}/planner.mjs")
add_custom_command(
  OUTPUT "${planner}"
  COMMAND
    ${emxx} -O2 -fexceptions ${wasm_objects} -o "${planner}" --js-library
    "${CMAKE_CURRENT_SOURCE_DIR}/wasm/library.js" -sSINGLE_FILE=1 -sMODULARIZE=1 -sEXPORT_ES6=1
    -sUSE_ES6_IMPORT_META=0 -sENVIRONMENT=worker -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB
    -sTOTAL_STACK=8MB -sFORCE_FILESYSTEM=1
    -sEXPORTED_FUNCTIONS=_planner_load,_planner_ask,_planner_bytes,_planner_size
    -sEXPORTED_RUNTIME_METHODS=FS,ccall
  DEPENDS ${wasm_objects} wasm/library.js
  COMMENT "Planner of the page")
