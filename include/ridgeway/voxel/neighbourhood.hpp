// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// How many bits of a number are ones. (A plain x86-64 has no instruction for it, and std::popcount
/// is a call.)
constexpr int bit_count(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555u;                                  // of each two bits
  bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);  // of each four
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return static_cast<int>(bits * 0x0101010101010101u >> 56);
}

/// The 3x3x3 cube around a voxel as 27 bits: bit (dx+1) + 3 (dy+1) + 9 (dz+1). The same number
/// names a direction; 13 is the voxel itself.
using Cube27 = std::uint32_t;
using Direction = std::uint8_t;  ///< One of the 27 cells of such a cube, by its bit.

inline constexpr Direction kCentre = 13;             ///< The voxel itself.
inline constexpr Cube27 kCentreBit = 1u << kCentre;  ///< The cube with that cell alone.
inline constexpr Cube27 kAllCells = (1u << 27) - 1;  ///< The full cube.

namespace detail {
inline constexpr std::array<VoxelIndex, 27> kOffsets = [] {
  std::array<VoxelIndex, 27> offsets;
  for (int d = 0; d < 27; ++d)
    offsets[static_cast<std::size_t>(d)] = {d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1};
  return offsets;
}();
inline constexpr std::array<std::int8_t, 27> kSquaredLengths = [] {
  std::array<std::int8_t, 27> lengths{};
  for (std::size_t d = 0; d < 27; ++d) {
    const VoxelIndex& o = kOffsets[d];
    lengths[d] = static_cast<std::int8_t>(o.x * o.x + o.y * o.y + o.z * o.z);
  }
  return lengths;
}();
}  // namespace detail

/// The step in a direction, -1, 0 or 1 along each axis.
constexpr const VoxelIndex& offset_of(int direction) {
  return detail::kOffsets[static_cast<std::size_t>(direction)];
}

/// The inverse of `offset_of`.
constexpr int direction_of(const VoxelIndex& offset) {
  return (offset.x + 1) + 3 * (offset.y + 1) + 9 * (offset.z + 1);
}

/// The direction of the step back.
constexpr int opposite(int direction) { return 26 - direction; }

/// Squared length of the step in a direction, voxels: 0 to 3.
constexpr int squared_length(int direction) {
  return detail::kSquaredLengths[static_cast<std::size_t>(direction)];
}

namespace detail {
/// Of the eight places along an axis, those whose neighbour a step away is one of them too: a bit
/// each.
constexpr std::uint64_t places_along(int step) { return step == 0 ? 0xff : step > 0 ? 0x7f : 0xfe; }
/// By direction: a bit for each place in a block whose neighbour there lies in the block too. Put
/// together of whole rows: every source that includes this file pays for it.
inline constexpr auto kInBlock = [] {
  std::array<std::array<std::uint64_t, kBlockSide>, 27> inside{};
  for (std::size_t d = 0; d < 27; ++d) {
    const VoxelIndex& o = kOffsets[d];
    std::uint64_t slice = 0;
    for (int y = 0; y < kBlockSide; ++y)
      if (places_along(o.y) >> y & 1) slice |= places_along(o.x) << kBlockSide * y;
    for (std::size_t z = 0; z < kBlockSide; ++z)
      if (places_along(o.z) >> z & 1) inside[d][z] = slice;
  }
  return inside;
}();
inline constexpr std::array<int, 27> kStepsInBlock = [] {
  std::array<int, 27> steps{};
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex o = offset_of(d);
    steps[static_cast<std::size_t>(d)] = o.x + kBlockSide * (o.y + kBlockSide * o.z);
  }
  return steps;
}();
}  // namespace detail

/// Whether the neighbour of a voxel in a direction lies in the same block.
constexpr bool has_neighbour_in_block(VoxelId id, int direction) {
  const VoxelId place = id % kBlockVoxels;
  return detail::kInBlock[static_cast<std::size_t>(direction)][place / 64] >> place % 64 & 1;
}
/// That neighbour, where it does.
constexpr VoxelId neighbour_in_block(VoxelId id, int direction) {
  return id + static_cast<VoxelId>(detail::kStepsInBlock[static_cast<std::size_t>(direction)]);
}

namespace detail {
constexpr Cube27 cells_up_to(int longest) {
  Cube27 cells = 0;
  for (int d = 0; d < 27; ++d)
    if (d != kCentre && squared_length(d) <= longest) cells |= 1u << d;
  return cells;
}
constexpr Cube27 cells_where(int axis, int value) {
  Cube27 cells = 0;
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex o = offset_of(d);
    if ((axis == 0 ? o.x : axis == 1 ? o.y : o.z) == value) cells |= 1u << d;
  }
  return cells;
}
}  // namespace detail

/// Cells that share a face with the centre.
inline constexpr Cube27 kCells6 = detail::cells_up_to(1);
/// Those that share a face or an edge with it.
inline constexpr Cube27 kCells18 = detail::cells_up_to(2);
/// Those that share a face, an edge or a corner with it.
inline constexpr Cube27 kCells26 = detail::cells_up_to(3);

/// The directions of kCells6, ascending.
inline constexpr std::array<Direction, 6> kFaceDirections = {4, 10, 12, 14, 16, 22};

/// All cells 26-adjacent to (or in) a set of cells of the cube. `Cells`: a cube, or a vector of
/// cubes of the compiler's.
template <typename Cells>
constexpr Cells grow26(Cells cells) {
  constexpr Cube27 not_first_x = ~detail::cells_where(0, -1) & kAllCells;
  constexpr Cube27 not_last_x = ~detail::cells_where(0, 1) & kAllCells;
  constexpr Cube27 not_first_y = ~detail::cells_where(1, -1) & kAllCells;
  constexpr Cube27 not_last_y = ~detail::cells_where(1, 1) & kAllCells;
  cells |= ((cells & not_last_x) << 1) | ((cells & not_first_x) >> 1);
  cells |= ((cells & not_last_y) << 3) | ((cells & not_first_y) >> 3);
  return (cells | cells << 9 | cells >> 9) & kAllCells;
}

/// All cells 6-adjacent to (or in) a set of cells of the cube.
template <typename Cells>
constexpr Cells grow6(Cells cells) {
  constexpr Cube27 not_first_x = ~detail::cells_where(0, -1) & kAllCells;
  constexpr Cube27 not_last_x = ~detail::cells_where(0, 1) & kAllCells;
  constexpr Cube27 not_first_y = ~detail::cells_where(1, -1) & kAllCells;
  constexpr Cube27 not_last_y = ~detail::cells_where(1, 1) & kAllCells;
  return (cells | (cells & not_last_x) << 1 | (cells & not_first_x) >> 1 |
          (cells & not_last_y) << 3 | (cells & not_first_y) >> 3 | cells << 9 | cells >> 9) &
         kAllCells;
}

/// Cells of `within` that are reached from `seed` by 26-steps inside `within`.
constexpr Cube27 flood26(Cube27 seed, Cube27 within) {
  for (seed &= within;;) {
    const Cube27 grown = grow26(seed) & within;
    if (grown == seed) return seed;
    seed = grown;
  }
}

/// Cells of `within` that are reached from `seed` by 6-steps inside `within`.
constexpr Cube27 flood6(Cube27 seed, Cube27 within) {
  for (seed &= within;;) {
    const Cube27 grown = grow6(seed) & within;
    if (grown == seed) return seed;
    seed = grown;
  }
}

}  // namespace ridgeway
