// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "endpoint.hpp"

#include <algorithm>
#include <vector>

#include "layout_box.hpp"

namespace ridgeway::detail {
namespace {

/// Voxels in each direction. Between obstacles a robot may fit where no centre of a voxel beside it
/// is free, and where it sees one a little farther off.
constexpr int kFarthestCentre = 3;

std::vector<VoxelIndex> offsets_by_distance(const Point& point, const VoxelIndex& home,
                                            double voxel_size, int reach) {
  struct Candidate {
    double distance;
    VoxelIndex offset;
  };
  const auto side = static_cast<std::size_t>(2 * reach + 1);
  std::vector<Candidate> candidates;
  candidates.reserve(side * side * side);
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        candidates.push_back(
            {(centre_of(home + VoxelIndex{x, y, z}, voxel_size) - point).squaredNorm(), {x, y, z}});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  std::vector<VoxelIndex> offsets;
  offsets.reserve(candidates.size());
  for (const Candidate& candidate : candidates) offsets.push_back(candidate.offset);
  return offsets;
}

/// The voxel that holds a place; of those that share it, as it lies on a face, one that is open.
VoxelIndex voxel_around(const EsdfMap& esdf, const Point& point) {
  constexpr double kSlack = 1e-9;  // voxels
  const VoxelIndex voxel = voxel_at(point, esdf.voxel_size);
  if (esdf.unknown == UnknownPolicy::kObstacle || esdf.is_open(esdf.layout.find(voxel)))
    return voxel;
  const Point off = Point::Constant(kSlack * esdf.voxel_size);
  const VoxelIndex low = voxel_at(point - off, esdf.voxel_size),
                   high = voxel_at(point + off, esdf.voxel_size);
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (esdf.is_open(esdf.layout.find({x, y, z}))) return {x, y, z};
  return voxel;
}

}  // namespace

Endpoint find_endpoint(const FreeSpace& space, const Point& point, double radius) {
  const EsdfMap& esdf = space.map();
  if (!has_voxel(point, esdf.voxel_size)) return {};
  const VoxelIndex voxel = voxel_around(esdf, point);
  const VoxelId home = esdf.layout.find(voxel);
  if (home == kNoVoxel)
    return {LayoutBox(esdf.layout).meets(voxel, voxel) ? EndpointStatus::kUnknown
                                                       : EndpointStatus::kOutsideMap,
            kNoVoxel};
  if (esdf.state[home] == VoxelState::kUnknown && !esdf.is_open(home))
    return {EndpointStatus::kUnknown, kNoVoxel};
  if (!space.is_within_limits(point, point)) return {EndpointStatus::kOutsideLimits, kNoVoxel};
  const double off = (point - centre_of(voxel, esdf.voxel_size)).norm();
  if (esdf.is_open(home) &&
      esdf.known_squared(home).metres(esdf.voxel_size) - off >= space.outer_radius(radius) &&
      space.is_within_limits(home))
    return {EndpointStatus::kOk, home};  // in the ball that is free around the centre
  if (!space.is_free(point, radius)) return {EndpointStatus::kInCollision, kNoVoxel};

  const SquaredHalves threshold = least_clearance(space.inner_radius(radius), esdf.voxel_size);
  const auto joins = [&](VoxelId id) {
    return esdf.is_open(id) && esdf.squared[id] >= threshold && space.is_within_limits(id) &&
           space.is_free(point, centre_of(esdf.layout.index_of(id), esdf.voxel_size), radius);
  };
  if (joins(home)) return {EndpointStatus::kOk, home};  // no centre is nearer
  // Centres around, the nearest first; farther ones only where no neighbour is in sight.
  for (const int reach : {1, kFarthestCentre})
    for (const VoxelIndex& o : offsets_by_distance(point, voxel, esdf.voxel_size, reach)) {
      const VoxelId id = esdf.layout.find(voxel + o);
      if (id != kNoVoxel && joins(id)) return {EndpointStatus::kOk, id};
    }
  return {EndpointStatus::kInCollision, kNoVoxel};
}

}  // namespace ridgeway::detail
