// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "endpoint.hpp"

#include <algorithm>
#include <array>

#include "layout_box.hpp"

namespace ridgeway::detail {
Endpoint find_endpoint(const FreeSpace& space, const Point& point, double radius) {
  const EsdfMap& esdf = space.map();
  if (!has_voxel(point, esdf.voxel_size)) return {};
  const VoxelIndex voxel = voxel_at(point, esdf.voxel_size);
  const VoxelId home = esdf.layout.find(voxel);
  if (home == kNoVoxel)
    return {LayoutBox(esdf.layout).meets(voxel, voxel) ? EndpointStatus::kUnknown
                                                       : EndpointStatus::kOutsideMap,
            kNoVoxel};
  if (esdf.state[home] == VoxelState::kUnknown && !esdf.is_open(home))
    return {EndpointStatus::kUnknown, kNoVoxel};
  if (!space.is_within_limits(point, point)) return {EndpointStatus::kOutsideLimits, kNoVoxel};
  const double off = (point - centre_of(voxel, esdf.voxel_size)).norm();
  if (esdf.is_open(home) && esdf.distance(home) - off >= space.outer_radius(radius) &&
      space.is_within_limits(home))
    return {EndpointStatus::kOk, home};  // in the ball that is free around the centre
  if (!space.is_free(point, radius)) return {EndpointStatus::kInCollision, kNoVoxel};

  const SquaredHalves threshold = least_clearance(space.inner_radius(radius), esdf.voxel_size);
  const auto joins = [&](VoxelId id) {
    return esdf.is_open(id) && esdf.squared[id] >= threshold && space.is_within_limits(id) &&
           space.is_free(point, centre_of(esdf.layout.index_of(id), esdf.voxel_size), radius);
  };
  if (joins(home)) return {EndpointStatus::kOk, home};  // no centre is nearer
  struct Candidate {
    double distance;
    int direction;
  };
  std::array<Candidate, 27> candidates;
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex o = offset_of(d);
    candidates[static_cast<std::size_t>(d)] = {
        (centre_of(voxel + o, esdf.voxel_size) - point).squaredNorm(), d};
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.direction < b.direction;
  });
  for (const Candidate& candidate : candidates) {
    const VoxelId id = esdf.layout.neighbour(home, candidate.direction);
    if (joins(id)) return {EndpointStatus::kOk, id};
  }
  return {EndpointStatus::kInCollision, kNoVoxel};
}

}  // namespace ridgeway::detail
