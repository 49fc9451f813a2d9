// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/occupancy_map.hpp"

#include <algorithm>

#include "planar.hpp"

namespace ridgeway {

VoxelCounts count_voxels(const OccupancyMap& map) {
  VoxelCounts counts;
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot) {
    const VoxelState* states = map.state.block(slot);
    const auto count = [states](VoxelState state) {
      return static_cast<std::size_t>(std::count(states, states + kBlockVoxels, state));
    };
    counts.free += count(VoxelState::kFree);
    counts.occupied += count(VoxelState::kOccupied);
  }
  counts.unknown = map.state.size() - counts.free - counts.occupied;
  const std::size_t layers = map.planar ? kBlockSide : 1;  // that are one
  return {counts.free / layers, counts.occupied / layers, counts.unknown / layers};
}

VoxelRange known_range(const OccupancyMap& map) {
  VoxelRange known = {kAllVoxels.max, kAllVoxels.min};
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot) {
    const BlockIndex& block = map.layout.block(slot);
    if (known.contains(voxel_of(block, 0)) && known.contains(voxel_of(block, kBlockVoxels - 1)))
      continue;
    const VoxelState* states = map.state.block(slot);
    for (int local = 0; local < kBlockVoxels; ++local) {
      if (states[local] == VoxelState::kUnknown) continue;
      const VoxelIndex v = voxel_of(block, local);
      known.min = {std::min(known.min.x, v.x), std::min(known.min.y, v.y),
                   std::min(known.min.z, v.z)};
      known.max = {std::max(known.max.x, v.x), std::max(known.max.y, v.y),
                   std::max(known.max.z, v.z)};
    }
  }
  return known;
}

std::optional<Box> known_bounds(const OccupancyMap& map) {
  VoxelRange known = known_range(map);
  if (known.empty()) return std::nullopt;
  if (map.planar) known.min.z = known.max.z = detail::kStandingLayer;
  const auto corner = [&map](const VoxelIndex& own) -> Point {
    const VoxelIndex v = map.origin + own;
    return Point(v.x, v.y, v.z) * map.voxel_size;
  };
  return Box{corner(known.min), corner(known.max + VoxelIndex{1, 1, 1})};
}

}  // namespace ridgeway
