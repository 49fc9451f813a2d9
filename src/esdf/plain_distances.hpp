// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"

/// Distances obstacle by obstacle: what the sweeps (distance_sweeps.cpp), the march
/// (segment_march.hpp) and the scan (obstacle_scan.hpp) compute, for tests. docs/fast-kernels.md
/// derives these from it.
namespace ridgeway::detail {

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
        if (is_obstacle(map.at({x, y, z}), policy)) obstacles.push_back({x, y, z});
      }
  return obstacles;
}

/// 4 d^2 from a voxel's centre to the nearest obstacle cube, and which one: of equally near ones
/// the first in (z, y, x) order, in which the obstacles must come.
struct PlainNearest {
  std::int64_t squared = kNoSite;
  VoxelIndex site;
};
inline PlainNearest plain_nearest(const VoxelIndex& v, const std::vector<VoxelIndex>& obstacles) {
  PlainNearest nearest;
  for (const VoxelIndex& o : obstacles) {
    std::int64_t squared = 0;
    for (const int k : {o.x - v.x, o.y - v.y, o.z - v.z}) {
      const std::int64_t twice = std::max(2 * std::abs(k) - 1, 0);
      squared += twice * twice;
    }
    if (squared < nearest.squared) nearest = {squared, o};
  }
  return nearest;
}

/// Squared distance, voxels, from a point (voxel units) to a unit cube.
inline double squared_distance_to_cube(const Eigen::Vector3d& p, const VoxelIndex& cube) {
  const double dx = std::max({cube.x - p.x(), p.x() - cube.x - 1.0, 0.0});
  const double dy = std::max({cube.y - p.y(), p.y() - cube.y - 1.0, 0.0});
  const double dz = std::max({cube.z - p.z(), p.z() - cube.z - 1.0, 0.0});
  return dx * dx + dy * dy + dz * dz;
}

/// To the nearest of the cubes.
inline double brute_squared_distance(const Eigen::Vector3d& p,
                                     const std::vector<VoxelIndex>& obstacles) {
  double best = std::numeric_limits<double>::infinity();
  for (const VoxelIndex& o : obstacles) best = std::min(best, squared_distance_to_cube(p, o));
  return best;
}

/// The smallest along a segment. The distance to a cube is convex along it, so thirds that cannot
/// hold the least are dropped.
inline double brute_squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     const std::vector<VoxelIndex>& obstacles) {
  double best = brute_squared_distance(a, obstacles);
  for (const VoxelIndex& o : obstacles) {
    const auto at = [&](double t) { return squared_distance_to_cube(a + t * (b - a), o); };
    if (std::sqrt(at(0.5)) - 0.5 * (b - a).norm() > std::sqrt(best)) continue;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 64; ++i) {
      const double third = (high - low) / 3.0;
      if (at(low + third) <= at(high - third)) {
        high -= third;
      } else {
        low += third;
      }
    }
    best = std::min(best, at(0.5 * (low + high)));
  }
  return best;
}

}  // namespace ridgeway::detail
