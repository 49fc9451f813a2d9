// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ray_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "field_along.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::uint32_t kTwoVoxels = 16;  // squared half voxels

/// How far along a ray its voxel is left, from where it is at a point.
double way_out(const Point& p, const VoxelIndex& voxel, const Eigen::Vector3d& direction,
               double voxel_size) {
  const Eigen::Vector3d low = Eigen::Vector3d(voxel.x, voxel.y, voxel.z) * voxel_size;
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double face = direction[axis] > 0.0 ? low[axis] + voxel_size : low[axis];
    nearest = std::min(nearest, (face - p[axis]) / direction[axis]);
  }
  return std::max(nearest, 0.0);
}

}  // namespace

bool sees(const EsdfMap& esdf, const Point& from, const VoxelIndex& target) {
  const double s = esdf.voxel_size;
  const Point to = centre_of(target, s);
  const double length = (to - from).norm();
  if (length == 0.0) return true;
  const Eigen::Vector3d direction = (to - from) / length;
  const double nudge = 1e-7 * s;  // into the next voxel
  FieldAlong field(esdf);
  for (double t = 0.0; t < length;) {
    const Point p = from + t * direction;
    const VoxelIndex voxel = voxel_at(p, s);
    if (voxel == target) return true;
    field.move_to(voxel);
    if (field.squared() == 0) return false;
    const double free =
        field.squared() > kTwoVoxels ? field.distance() - (p - centre_of(voxel, s)).norm() : 0.0;
    t += free > 2.0 * s ? free : way_out(p, voxel, direction, s) + nudge;
  }
  return true;
}

double depth_behind(const EsdfMap& esdf, const VoxelRange& within, const FrontierPart& part,
                    double most) {
  constexpr std::size_t kSamples = 3;
  constexpr double kUneven = 0.2;  // length of the normal of a part that faces all sides
  const double s = esdf.voxel_size;
  const double length = part.normal.norm();
  const int deepest = static_cast<int>(most / s);
  if (length < kUneven || deepest < 1) return 1.0;
  const Eigen::Vector3d step = part.normal / length * s;
  const std::size_t count = part.targets.size(), samples = std::min(count, kSamples);
  VoxelFinder finder(esdf.layout);
  int depth = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const Point from = centre_of(part.targets[(2 * i + 1) * count / (2 * samples)], s);
    for (int k = 1; k < deepest; ++k) {
      const VoxelIndex voxel = voxel_at(from + k * step, s);
      if (!within.contains(voxel + esdf.origin)) break;
      const VoxelId id = finder.find(voxel);
      if (id != kNoVoxel && esdf.state[id] != VoxelState::kUnknown) break;
      ++depth;
    }
  }
  return 1.0 + static_cast<double>(depth) / static_cast<double>(samples);
}

}  // namespace ridgeway::detail
