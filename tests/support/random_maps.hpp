// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::testing {

/// A map whose voxel states inside [low, high] (inclusive) come from a function.
inline OccupancyMap make_map(double voxel_size, const VoxelIndex& low, const VoxelIndex& high,
                             const std::function<VoxelState(const VoxelIndex&)>& state_at) {
  std::vector<BlockIndex> blocks;
  const BlockIndex first = block_of(low), last = block_of(high);
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) blocks.push_back({x, y, z});
  OccupancyMap map;
  map.voxel_size = voxel_size;
  map.layout = BlockLayout(std::move(blocks));
  map.state = VoxelField<VoxelState>(map.layout);
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        map.state[map.layout.find({x, y, z})] = state_at({x, y, z});
  return map;
}

/// Drops blocks of a map that hold nothing known, so that layouts have gaps.
inline OccupancyMap drop_unknown_blocks(const OccupancyMap& map) {
  std::vector<BlockIndex> blocks;
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    for (int v = 0; v < kBlockVoxels; ++v)
      if (map.state.block(slot)[v] != VoxelState::kUnknown) {
        blocks.push_back(map.layout.block(slot));
        break;
      }
  OccupancyMap result;
  result.voxel_size = map.voxel_size;
  result.layout = BlockLayout(std::move(blocks));
  result.state = VoxelField<VoxelState>(result.layout);
  for (std::uint32_t slot = 0; slot < result.layout.block_count(); ++slot)
    std::copy_n(map.state.block(map.layout.find_block(result.layout.block(slot))), kBlockVoxels,
                result.state.block(slot));
  return result;
}

/// Boxes of free space carved out of the unknown or out of occupied matter, with occupied specks
/// and slabs: rooms, gaps, walls and isolated voxels, over several blocks, at a random place.
inline OccupancyMap random_map(unsigned seed, int side = 20, double voxel_size = 0.1) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const VoxelIndex low{below(40) - 20, below(40) - 20, below(40) - 20};
  const VoxelIndex high = low + VoxelIndex{side + below(6), side + below(6), side / 2 + below(6)};
  const VoxelState filling = below(2) == 0 ? VoxelState::kUnknown : VoxelState::kOccupied;
  OccupancyMap map = make_map(voxel_size, low, high, [&](const VoxelIndex&) { return filling; });
  const auto fill = [&](VoxelState state, int largest) {
    const VoxelIndex size{1 + below(largest), 1 + below(largest), 1 + below(largest)};
    const VoxelIndex extent = high - low;
    const VoxelIndex from = low + VoxelIndex{below(extent.x), below(extent.y), below(extent.z)};
    for (int z = from.z; z < from.z + size.z && z <= high.z; ++z)
      for (int y = from.y; y < from.y + size.y && y <= high.y; ++y)
        for (int x = from.x; x < from.x + size.x && x <= high.x; ++x)
          map.state[map.layout.find({x, y, z})] = state;
  };
  const int rooms = 2 + below(6), things = below(12), specks = below(20);
  for (int i = 0; i < rooms; ++i) fill(VoxelState::kFree, side);
  for (int i = 0; i < things; ++i) fill(VoxelState::kOccupied, side / 3);
  for (int i = 0; i < things / 2; ++i) fill(VoxelState::kUnknown, side / 3);
  for (int i = 0; i < specks; ++i) fill(VoxelState::kOccupied, 1);
  return drop_unknown_blocks(map);
}

}  // namespace ridgeway::testing
