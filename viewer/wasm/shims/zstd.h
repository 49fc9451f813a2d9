// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>

/// The part of zstd that reading a .ridge file takes, for the planner that runs in the page: what
/// is packed is handed to JavaScript (planner.js), as Debian has no zstd for WebAssembly.
extern "C" {

struct ZSTD_DCtx {};
inline ZSTD_DCtx* ZSTD_createDCtx() { return new ZSTD_DCtx; }
inline std::size_t ZSTD_freeDCtx(ZSTD_DCtx* context) {
  delete context;
  return 0;
}

/// Bytes written; more than there is room for where it cannot be unpacked.
std::size_t ridgeway_unpack(void* to, std::size_t room, const void* from, std::size_t bytes);

inline std::size_t ZSTD_decompressDCtx(ZSTD_DCtx*, void* to, std::size_t room, const void* from,
                                       std::size_t bytes) {
  return ridgeway_unpack(to, room, from, bytes);
}
inline unsigned ZSTD_isError(std::size_t size) { return size == static_cast<std::size_t>(-1); }
/// As zstd itself defines it.
constexpr std::size_t ZSTD_compressBound(std::size_t bytes) {
  constexpr std::size_t kMargin = 128 << 10;
  return bytes + (bytes >> 8) + (bytes < kMargin ? (kMargin - bytes) >> 11 : 0);
}
}
