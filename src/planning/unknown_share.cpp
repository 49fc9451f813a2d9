// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/unknown_share.hpp"

#include <algorithm>

#include "paths/shorten.hpp"

namespace ridgeway {
namespace {

constexpr double kStep = 8.0;      // voxels between looks at what the path borders
constexpr double kMostLooks = 32;  // with more between them on long paths

bool borders_unknown(const EsdfMap& esdf, VoxelFinder& finder, const Point& p) {
  const VoxelIndex v = voxel_at(p, esdf.voxel_size);
  const VoxelId id = finder.find(v);
  if (id == kNoVoxel || esdf.squared[id] == kNoSite) return false;
  const SiteOffset o = esdf.site[id];
  const VoxelId site = finder.find(v + VoxelIndex{o.x, o.y, o.z});
  return site == kNoVoxel || esdf.state[site] == VoxelState::kUnknown;
}

}  // namespace

double unknown_share(const EsdfMap& esdf, std::span<const Point> path) {
  const double length = length_of(path);
  if (length <= 0.0) return 0.0;
  const int pieces =
      static_cast<int>(std::min(1.0 + length / (kStep * esdf.voxel_size), kMostLooks));
  const double piece = length / pieces;
  VoxelFinder finder(esdf.layout);
  int looks = 0, unknown = 0;
  double before = 0.0;  // length up to the segment
  for (std::size_t i = 1; i < path.size() && looks < pieces; ++i) {
    const Point along = path[i] - path[i - 1];
    const double own = along.norm();
    for (; looks < pieces && (looks + 0.5) * piece <= before + own; ++looks)
      unknown += borders_unknown(esdf, finder,
                                 path[i - 1] + along * (((looks + 0.5) * piece - before) / own));
    before += own;
  }
  return static_cast<double>(unknown) / pieces;
}

}  // namespace ridgeway
