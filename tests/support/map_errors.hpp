// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/sensing/world.hpp"
#include "support/lattice.hpp"

namespace ridgeway {

struct MapErrors {
  double mean = 0.0, p99 = 0.0;  ///< voxels
  std::size_t voxels = 0;
};

/// Off the exact distance where the map says that it is within the truncation.
inline MapErrors errors_of(const TsdfMap& map, const World& world) {
  std::vector<double> off;
  double sum = 0.0;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (map.weight[id] <= 0.0f || std::abs(map.distance[id]) >= 0.99 * map.truncation) continue;
    const Point centre = testing::centre_in_world(map, id);
    off.push_back(std::abs(map.distance[id] - surface_distance(world, centre).distance) /
                  map.voxel_size);
    sum += off.back();
  }
  std::sort(off.begin(), off.end());
  if (off.empty()) return {};
  return {sum / static_cast<double>(off.size()), off[off.size() * 99 / 100], off.size()};
}

}  // namespace ridgeway
