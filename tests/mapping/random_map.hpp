// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <random>
#include <utility>

#include "ridgeway/mapping/occupancy_builder.hpp"
#include "support/lattice.hpp"

namespace ridgeway::testing {

/// Voxels around the origin in all three states, clumped so that coarse voxels of one state exist.
inline OccupancyMap clumped_map(unsigned seed, double voxel_size = 0.1, int half_side = 20) {
  std::mt19937 random(seed);
  const auto below = [&random](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
  };
  OccupancyBuilder builder(voxel_size);
  for (int i = 0; i < 12; ++i) {
    const VoxelIndex low = {below(2 * half_side) - half_side, below(2 * half_side) - half_side,
                            below(2 * half_side) - half_side};
    builder.fill({low, low + VoxelIndex{below(18), below(18), below(18)}}, VoxelState::kFree);
  }
  for (int i = 0; i < 60; ++i)
    builder.set({below(2 * half_side) - half_side, below(2 * half_side) - half_side,
                 below(2 * half_side) - half_side},
                VoxelState::kOccupied);
  return std::move(builder).finish();
}

/// Calls visit(voxel of the lattice, state) for all known voxels.
template <typename Visit>
void for_each_known(const OccupancyMap& map, const Visit& visit) {
  for (VoxelId id = 0; id < map.state.size(); ++id)
    if (map.state[id] != VoxelState::kUnknown)
      visit(map.origin + map.layout.index_of(id), map.state[id]);
}

/// Calls visit(voxel) for all voxels of a range.
template <typename Visit>
void for_each_in(const VoxelRange& range, const Visit& visit) {
  for (int z = range.min.z; z <= range.max.z; ++z)
    for (int y = range.min.y; y <= range.max.y; ++y)
      for (int x = range.min.x; x <= range.max.x; ++x) visit(VoxelIndex{x, y, z});
}

/// Do two maps hold the same known voxels, whatever their blocks?
inline bool same_voxels(const OccupancyMap& a, const OccupancyMap& b) {
  bool same = a.voxel_size == b.voxel_size;
  for_each_known(a,
                 [&](const VoxelIndex& v, VoxelState state) { same &= state_at(b, v) == state; });
  for_each_known(b,
                 [&](const VoxelIndex& v, VoxelState state) { same &= state_at(a, v) == state; });
  return same;
}

}  // namespace ridgeway::testing
