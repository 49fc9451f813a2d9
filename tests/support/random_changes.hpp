// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::testing {

inline std::vector<BlockIndex> blocks_of_box(const BlockIndex& low, const BlockIndex& high) {
  std::vector<BlockIndex> blocks;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) blocks.push_back({x, y, z});
  return blocks;
}

/// What makes a map of nothing, voxel by voxel, in the lattice.
inline std::vector<VoxelChange> changes_to(const OccupancyMap& map) {
  std::vector<VoxelChange> changes;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.state[id] != VoxelState::kUnknown)
      changes.push_back({map.origin + map.layout.index_of(id), map.state[id]});
  return changes;
}

/// Boxes and specks of any state at random places of a box: what comes, goes and comes again.
inline std::vector<VoxelChange> random_changes(std::mt19937& random, const VoxelIndex& low,
                                               const VoxelIndex& high) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<VoxelChange> changes;
  const auto fill = [&](int largest, VoxelState state) {
    const VoxelIndex size{1 + below(largest), 1 + below(largest), 1 + below(largest)};
    const VoxelIndex extent = high - low;
    const VoxelIndex from = low + VoxelIndex{below(extent.x), below(extent.y), below(extent.z)};
    for (int z = from.z; z < std::min(from.z + size.z, high.z); ++z)
      for (int y = from.y; y < std::min(from.y + size.y, high.y); ++y)
        for (int x = from.x; x < std::min(from.x + size.x, high.x); ++x)
          changes.push_back({{x, y, z}, state});
  };
  constexpr VoxelState kStates[] = {VoxelState::kUnknown, VoxelState::kFree, VoxelState::kFree,
                                    VoxelState::kOccupied};
  const int boxes = below(4), specks = below(12);
  for (int i = 0; i < boxes; ++i) fill(i == 0 ? 24 : 6, kStates[below(4)]);
  for (int i = 0; i < specks; ++i) fill(1, kStates[below(4)]);
  return changes;
}

}  // namespace ridgeway::testing
