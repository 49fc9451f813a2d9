// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// Values of a block's voxels and of a border of one voxel around them, x fastest: 10 x 10 x 10.
template <typename Value>
using Bordered = std::array<Value, 1000>;

/// Place of a block's voxel in a Bordered; its neighbour's is `bordered_step(direction)` further.
constexpr std::size_t bordered_place(VoxelId id) {
  return ((id >> 6 & 7) + 1) * 100 + ((id >> 3 & 7) + 1) * 10 + (id & 7) + 1;
}
constexpr int bordered_step(int direction) {
  const VoxelIndex o = offset_of(direction);
  return o.x + 10 * o.y + 100 * o.z;
}

/// Calls body(place, id, count) for all voxels of a block and its border, `count` (8 or 1, a
/// constant) in a row at a time; kNoVoxel for those in blocks that are not allocated.
template <typename Body>
void for_each_bordered_row(const BlockLayout& layout, std::uint32_t slot, const Body& body) {
  std::size_t place = 0;
  for (int z = -1; z <= kBlockSide; ++z)
    for (int y = -1; y <= kBlockSide; ++y) {
      const int beside = 13 + 3 * (y >> 3) + 9 * (z >> 3);
      const auto row = static_cast<VoxelId>((y & 7) << 3 | (z & 7) << 6);
      const auto visit = [&](int dx, VoxelId x, auto count) {
        const std::uint32_t n = layout.neighbour_block(slot, beside + dx);
        body(place, n == BlockLayout::kNoBlock ? kNoVoxel : n * kBlockVoxels + row + x, count);
        place += count;
      };
      constexpr std::integral_constant<std::size_t, 1> kOne;
      visit(-1, kBlockSide - 1, kOne);
      visit(0, 0, std::integral_constant<std::size_t, kBlockSide>());
      visit(1, 0, kOne);
    }
}

/// Numbers of four voxels in a row along x, the first at a multiple of four, for the compiler to
/// compare at once: comparisons give all ones where they hold.
inline constexpr int kLanes = 4;
using Cubes [[gnu::vector_size(16)]] = Cube27;
using Floats [[gnu::vector_size(16)]] = float;

template <typename Lanes>
Lanes load_lanes(const void* first) {
  Lanes lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

/// The first cells of four cubes that are not empty, as directions.
inline Cubes first_cells(const Cubes& cubes) {
  using Signed [[gnu::vector_size(16)]] = std::int32_t;
  const auto lowest = reinterpret_cast<Signed>(cubes & -cubes);
  // Of a power of two as a float, the exponent.
  return (reinterpret_cast<Cubes>(__builtin_convertvector(lowest, Floats)) >> 23) - 127u;
}

/// Calls body(first of four voxels, those of a mask as four bits) for a block, where there are any.
template <typename Body>
void for_each_four(const VoxelMask& mask, std::uint32_t slot, const Body& body) {
  for (std::uint32_t place = 0; place < kBlockVoxels; place += kLanes)
    if (const unsigned members = mask.block(slot)[place / 64] >> (place % 64) & 0xf; members != 0)
      body(slot * kBlockVoxels + place, members);
}

}  // namespace ridgeway::detail
