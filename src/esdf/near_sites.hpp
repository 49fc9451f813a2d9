// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <limits>

#include "box_distance.hpp"
#include "obstacle_scan.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Squared distance (voxel units) from a place to the nearest of the sites of the eight voxels
/// around it: never less than that to the nearest obstacle, and nearly always the same, at the
/// price of eight looks however far it is. Infinite where none of them has a site.
inline double squared_to_near_sites(const EsdfMap& esdf, VoxelFinder& finder,
                                    const Eigen::Vector3d& p) {
  const VoxelIndex base = voxel_at(p - Eigen::Vector3d::Constant(0.5), 1.0);
  double best = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const VoxelIndex voxel = base + VoxelIndex{corner & 1, corner >> 1 & 1, corner >> 2};
    const VoxelId id = finder.find(voxel);
    if (id == kNoVoxel || esdf.squared[id] == kNoSite) continue;
    const SiteOffset site = esdf.site[id];
    best = std::min(best, squared_distance(p, cube_of(voxel + VoxelIndex{site.x, site.y, site.z})));
  }
  return best;
}

}  // namespace ridgeway::detail
