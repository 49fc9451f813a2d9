// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "voxel/cube_gather.hpp"

/// What is thinner than a voxel (a pipe, a cable, a sheet) may lie between the voxels' centres:
/// then no distance is negative, and by their signs alone all voxels around it are free. But one of
/// them is near to it, and where there is a surface that has a voxel behind it, that one is
/// occupied.
namespace ridgeway::detail {

/// Voxels: no sheet or rod of any direction is farther than sqrt(1/2) from the nearest centre; and
/// of a centre nearer than 1 to a plane one of those beside it, across a face or an edge, is beyond
/// the plane.
inline constexpr double kNearSurface = 0.75;

/// Of the free voxels of a block those with free ones across all faces, where what is outside of
/// the block is taken for free: for most blocks this tells that there are none to be looked at.
inline VoxelMask::Block maybe_inner(const VoxelMask::Block& free) {
  constexpr std::uint64_t kFirstX = 0x0101010101010101u, kLastX = kFirstX << 7;
  constexpr std::uint64_t kFirstY = 0xffu, kLastY = kFirstY << 56;
  VoxelMask::Block inner;
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t layer = free[z];
    inner[z] = layer & (layer << 1 | kFirstX) & (layer >> 1 | kLastX) & (layer << 8 | kFirstY) &
               (layer >> 8 | kLastY);
    if (z > 0) inner[z] &= free[z - 1];
    if (z + 1 < kBlockSide) inner[z] &= free[z + 1];
  }
  return inner;
}

/// Free voxels that are near a surface and have free ones across all faces and edges. `near`: free
/// ones nearer than kNearSurface to a surface that was measured. `free_in(direction)`: the free
/// voxels of the block in one of 27 directions, or null.
template <typename FreeIn>
VoxelMask::Block thin_surfaces(const VoxelMask::Block& near, const VoxelMask::Block& free,
                               const FreeIn& free_in) {
  VoxelMask::Block thin = maybe_inner(free);
  std::uint64_t any = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z) any |= thin[z] &= near[z];
  if (any == 0) return thin;
  const VoxelMask::Block inner = CubeGather(free_in).surrounded();
  for (std::size_t z = 0; z < kBlockSide; ++z) thin[z] &= inner[z];
  return thin;
}

/// Occupies those of a map. `distance`: of its voxels to the nearest surface that was measured,
/// metres, on the same layout; what it holds of voxels that are not free plays no part.
void occupy_thin_surfaces(const VoxelField<float>& distance, OccupancyMap& map);

}  // namespace ridgeway::detail
