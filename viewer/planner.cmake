# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors

# The library's own planner for WebAssembly: the sources that answering the page takes, and stand-ins
# for what Debian has not for it (shims/: oneTBB on one thread, zstd by way of JavaScript).
set(EMXX_FLAGS
    -std=c++20 -O2 -DNDEBUG -fexceptions -DRIDGEWAY_STOP_AND_GO
    "-I${CMAKE_CURRENT_SOURCE_DIR}/wasm/shims" "-I${PROJECT_SOURCE_DIR}/include"
    "-I${PROJECT_BINARY_DIR}/include" "-I${PROJECT_SOURCE_DIR}/src"
    "-I${PROJECT_SOURCE_DIR}/apps/ridgeway" -isystem/usr/include/eigen3
    "-I${CMAKE_CURRENT_BINARY_DIR}/include" -include missing.hpp -Wno-everything)
file(MAKE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/include")
file(CREATE_LINK /usr/include/nlohmann "${CMAKE_CURRENT_BINARY_DIR}/include/nlohmann" SYMBOLIC)
