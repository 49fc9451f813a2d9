// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/occupancy_map.hpp"

#include <algorithm>
#include <array>

namespace ridgeway {

VoxelCounts count_voxels(const OccupancyMap& map) {
  const auto& states = map.state.values();
  const auto count = [&states](VoxelState state) {
    return static_cast<std::size_t>(std::count(states.begin(), states.end(), state));
  };
  const std::size_t free = count(VoxelState::kFree), occupied = count(VoxelState::kOccupied);
  return {.free = free, .occupied = occupied, .unknown = states.size() - free - occupied};
}

std::optional<Box> known_bounds(const OccupancyMap& map) {
  std::optional<std::array<VoxelIndex, 2>> range;
  const auto include = [&range](const VoxelIndex& v) {
    if (!range) range = {v, v};
    auto& [low, high] = *range;
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  };
  const auto inside = [&range](const VoxelIndex& v) {
    if (!range) return false;
    const auto& [low, high] = *range;
    return v.x >= low.x && v.y >= low.y && v.z >= low.z && v.x <= high.x && v.y <= high.y &&
           v.z <= high.z;
  };
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot) {
    const BlockIndex& block = map.layout.block(slot);
    if (inside(voxel_of(block, 0)) && inside(voxel_of(block, kBlockVoxels - 1))) continue;
    const VoxelState* states = map.state.block(slot);
    for (int local = 0; local < kBlockVoxels; ++local)
      if (states[local] != VoxelState::kUnknown) include(voxel_of(block, local));
  }
  if (!range) return std::nullopt;
  const auto& [low, high] = *range;
  return Box{Point(low.x, low.y, low.z) * map.voxel_size,
             Point(high.x + 1.0, high.y + 1.0, high.z + 1.0) * map.voxel_size};
}

}  // namespace ridgeway
