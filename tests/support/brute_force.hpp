// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway::testing {

/// Obstacle voxels in and one voxel around a map's blocks, in (z, y, x) order, found voxel by
/// voxel: all that can be the nearest to a voxel of the map.
inline std::vector<VoxelIndex> all_obstacles(const OccupancyMap& map, UnknownPolicy policy) {
  VoxelIndex low{1 << 20, 1 << 20, 1 << 20}, high{-(1 << 20), -(1 << 20), -(1 << 20)};
  for (const BlockIndex& b : map.layout.blocks()) {
    const VoxelIndex first = voxel_of(b, 0), last = voxel_of(b, kBlockVoxels - 1);
    low = {std::min(low.x, first.x), std::min(low.y, first.y), std::min(low.z, first.z)};
    high = {std::max(high.x, last.x), std::max(high.y, last.y), std::max(high.z, last.z)};
  }
  std::vector<VoxelIndex> obstacles;
  for (int z = low.z - 1; z <= high.z + 1; ++z)
    for (int y = low.y - 1; y <= high.y + 1; ++y)
      for (int x = low.x - 1; x <= high.x + 1; ++x) {
        const VoxelState state = map.at({x, y, z});
        if (state == VoxelState::kOccupied ||
            (state == VoxelState::kUnknown && policy == UnknownPolicy::kObstacle))
          obstacles.push_back({x, y, z});
      }
  return obstacles;
}

/// Squared distance, voxels, from a point (voxel units) to the nearest of the unit cubes.
inline double brute_squared_distance(const Eigen::Vector3d& p,
                                     const std::vector<VoxelIndex>& obstacles) {
  double best = std::numeric_limits<double>::infinity();
  for (const VoxelIndex& o : obstacles) {
    const double dx = std::max({o.x - p.x(), p.x() - o.x - 1.0, 0.0});
    const double dy = std::max({o.y - p.y(), p.y() - o.y - 1.0, 0.0});
    const double dz = std::max({o.z - p.z(), p.z() - o.z - 1.0, 0.0});
    best = std::min(best, dx * dx + dy * dy + dz * dz);
  }
  return best;
}

}  // namespace ridgeway::testing
