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
  // From one row of blocks to the next, so that neighbours are looked up once for all their voxels.
  const auto first_of = [](int beside) { return beside < 0 ? -1 : beside == 0 ? 0 : kBlockSide; };
  const auto last_of = [](int beside) { return beside < 0 ? -1 : beside == 0 ? 7 : kBlockSide; };
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy) {
      const auto first_in = [&](int dx) {
        const std::uint32_t n = layout.neighbour_block(slot, 13 + dx + 3 * dy + 9 * dz);
        return n == BlockLayout::kNoBlock ? kNoVoxel : n * kBlockVoxels;
      };
      const VoxelId before = first_in(-1), own = first_in(0), behind = first_in(1);
      for (int z = first_of(dz); z <= last_of(dz); ++z)
        for (int y = first_of(dy); y <= last_of(dy); ++y) {
          const auto row = static_cast<VoxelId>((y & 7) << 3 | (z & 7) << 6);
          const auto place = static_cast<std::size_t>((z + 1) * 100 + (y + 1) * 10);
          const auto visit = [&](std::size_t at, VoxelId block, VoxelId x, auto count) {
            body(place + at, block == kNoVoxel ? kNoVoxel : block + row + x, count);
          };
          constexpr std::integral_constant<std::size_t, 1> kOne;
          visit(0, before, kBlockSide - 1, kOne);
          visit(1, own, 0, std::integral_constant<std::size_t, kBlockSide>());
          visit(1 + kBlockSide, behind, 0, kOne);
        }
    }
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // what takes or gives wide numbers is always inlined
#endif

/// Numbers of some voxels in a row along x, the first at a multiple of their count, for the
/// compiler to compare at once: comparisons give all ones where they hold.
template <int lanes>
struct Row {
  using Cubes [[gnu::vector_size(4 * lanes)]] = Cube27;
  using Floats [[gnu::vector_size(4 * lanes)]] = float;
  using Signed [[gnu::vector_size(4 * lanes)]] = std::int32_t;
};

template <typename Lanes>
[[gnu::always_inline]] inline Lanes load_lanes(const void* first) {
  Lanes lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

/// The first cells of cubes that are not empty, as directions.
template <int lanes>
[[gnu::always_inline]] inline typename Row<lanes>::Cubes first_cells(
    const typename Row<lanes>::Cubes& cubes) {
  using Cubes = typename Row<lanes>::Cubes;
  const auto lowest = reinterpret_cast<typename Row<lanes>::Signed>(cubes & -cubes);
  // Of a power of two as a float, the exponent.
  return (reinterpret_cast<Cubes>(__builtin_convertvector(lowest, typename Row<lanes>::Floats)) >>
          23) -
         127u;
}

/// Calls body(first voxel of a row, those of a mask as bits) for the rows of a block in which there
/// are any.
template <int lanes, typename Body>
void for_each_row_of(const VoxelMask& mask, std::uint32_t slot, const Body& body) {
  constexpr unsigned kAll = (1u << lanes) - 1;
  for (std::uint32_t place = 0; place < kBlockVoxels; place += lanes)
    if (const unsigned members = mask.block(slot)[place / 64] >> (place % 64) & kAll; members != 0)
      body(slot * kBlockVoxels + place, members);
}

/// How many voxels are looked at at once, as a type.
template <int lanes>
using LaneCount = std::integral_constant<int, lanes>;

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
/// See with_lanes.
template <typename Body>
[[gnu::target("avx2"), gnu::flatten]] void with_wide_lanes(const Body& body) {
  body(LaneCount<8>());
}
#endif

/// Calls body(how many lanes), compiled for the widest registers of the machine that runs it: eight
/// lanes or four, by the same operations, so with the same results.
template <typename Body>
[[gnu::flatten]] void with_lanes(const Body& body) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("avx2")) return with_wide_lanes(body);
#endif
  body(LaneCount<4>());
}

}  // namespace ridgeway::detail
