// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {

inline constexpr std::uint32_t kBlocksPerChunk = 128;
/// Added to a voxel's state where it has no site.
inline constexpr std::uint8_t kNoSiteFlag = 4;

/// The blocks first .. last - 1 of one chunk.
struct BlockRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  std::size_t count() const { return last - first; }
};

inline BlockRange blocks_of_chunk(std::size_t chunk, std::uint32_t block_count) {
  const auto first = static_cast<std::uint32_t>(chunk * kBlocksPerChunk);
  return {first, std::min(block_count, first + kBlocksPerChunk)};
}

inline std::size_t chunks_for(std::uint32_t block_count) {
  return (block_count + kBlocksPerChunk - 1) / kBlocksPerChunk;
}

}  // namespace ridgeway
