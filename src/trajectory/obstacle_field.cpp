// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "obstacle_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace ridgeway::detail {
namespace {

constexpr int kReach = 2;  // voxels: nobody looks farther for a border, nor for a way out

/// Signed distance to the border of known-free space, voxels, within kReach: above 0 inside.
class FreeBorder {
 public:
  explicit FreeBorder(const EsdfMap& esdf) : esdf_(esdf) {}

  /// Trilinear between voxel centres; the gradient is per voxel.
  DistanceAndGradient at(const Point& p) {
    const Point shifted = p / esdf_.voxel_size - Point::Constant(0.5);
    const VoxelIndex base = voxel_at(shifted, 1.0);
    const Point t = shifted - Point(base.x, base.y, base.z);
    DistanceAndGradient result;
    for (int i = 0; i < 8; ++i) {
      const VoxelIndex corner{i & 1, i >> 1 & 1, i >> 2};
      const double wx = corner.x ? t.x() : 1.0 - t.x(), wy = corner.y ? t.y() : 1.0 - t.y(),
                   wz = corner.z ? t.z() : 1.0 - t.z();
      const double d = at_centre(base + corner);
      result.distance += wx * wy * wz * d;
      result.gradient +=
          d * Point((corner.x ? 1.0 : -1.0) * wy * wz, (corner.y ? 1.0 : -1.0) * wx * wz,
                    (corner.z ? 1.0 : -1.0) * wx * wy);
    }
    return result;
  }

 private:
  bool is_free(VoxelId id) const { return esdf_.is_open(id); }

  double at_centre(const VoxelIndex& v) {
    const auto part = [](int k) { return static_cast<std::uint64_t>(k) & 0x1fffff; };
    const std::uint64_t key = part(v.x) | part(v.y) << 21 | part(v.z) << 42;
    const auto [place, is_new] = known_.try_emplace(key, 0.0f);
    if (is_new) place->second = static_cast<float>(search(v));
    return place->second;
  }

  double search(const VoxelIndex& v) const {
    const VoxelId centre = esdf_.layout.find(v);
    const bool inside = is_free(centre);
    std::uint32_t nearest = 4 * kReach * kReach;
    for (int z = -kReach; z <= kReach; ++z)
      for (int y = -kReach; y <= kReach; ++y)
        for (int x = -kReach; x <= kReach; ++x) {
          const std::uint32_t squared = squared_halves(x) + squared_halves(y) + squared_halves(z);
          if (squared >= nearest) continue;
          const VoxelId id = centre != kNoVoxel ? esdf_.layout.step(centre, x, y, z)
                                                : esdf_.layout.find(v + VoxelIndex{x, y, z});
          if (is_free(id) != inside) nearest = squared;
        }
    return (inside ? 0.5 : -0.5) * std::sqrt(static_cast<double>(nearest));
  }

  const EsdfMap& esdf_;
  std::unordered_map<std::uint64_t, float> known_;
};

}  // namespace

namespace {

constexpr double kFlat = 1e-7;  // metres: a box so flat gives no direction to go

/// How far within the limits a place is, and where that grows; the nearest face decides.
DistanceAndGradient depth_within(const FlightLimits& limits, const Point& p) {
  DistanceAndGradient depth{std::numeric_limits<double>::infinity(), Point::Zero()};
  const auto look = [&](double distance, int axis, double sign) {
    if (distance < depth.distance) depth = {distance, sign * Point::Unit(axis)};
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (limits.keep_in.max[axis] - limits.keep_in.min[axis] < kFlat) continue;
    look(p[axis] - limits.keep_in.min[axis], axis, 1.0);
    look(limits.keep_in.max[axis] - p[axis], axis, -1.0);
  }
  for (const Box& box : limits.keep_out) {
    double farthest = -std::numeric_limits<double>::infinity();  // outside along that axis
    int of = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double outside = std::max(box.min[axis] - p[axis], p[axis] - box.max[axis]);
      if (outside > farthest) {
        farthest = outside;
        of = axis;
      }
    }
    look(farthest, of, box.min[of] - p[of] > p[of] - box.max[of] ? -1.0 : 1.0);
  }
  return depth;
}

/// Of obstacles and known space alone.
DistanceField field_of_map(const EsdfMap& esdf, double radius, double margin) {
  const double s = esdf.voxel_size, enough = radius + margin + 2.0 * s;
  const auto from_obstacles = [&esdf, s, enough](const Point& p) -> DistanceAndGradient {
    if (!has_voxel(p, s)) return {-kReach * s, Point::Zero()};  // a wild step of an optimiser
    const VoxelId id = esdf.layout.find(voxel_at(p, s));
    if (id != kNoVoxel && !esdf.is_obstacle(id) && esdf.distance(id) > enough)
      return {enough, Point::Zero()};
    return interpolate_distance(esdf, p, kReach * s);
  };
  if (esdf.unknown == UnknownPolicy::kObstacle) return from_obstacles;

  return [=, border = std::make_shared<FreeBorder>(esdf)](const Point& p) {
    DistanceAndGradient obstacle = from_obstacles(p);
    if (!has_voxel(p, s)) return obstacle;
    const DistanceAndGradient inside = border->at(p);
    const double scale = margin / kReach;  // the margin begins where the border comes into reach
    if (obstacle.distance <= radius + scale * inside.distance) return obstacle;
    return DistanceAndGradient{radius + scale * inside.distance, inside.gradient * (scale / s)};
  };
}

}  // namespace

DistanceField obstacle_field(const FreeSpace& space, double radius, double margin) {
  DistanceField of_map = field_of_map(space.map(), radius, margin);
  if (space.limits() == nullptr) return of_map;
  return [=, limits = *space.limits()](const Point& p) {
    const DistanceAndGradient obstacle = of_map(p), within = depth_within(limits, p);
    if (obstacle.distance <= radius + within.distance) return obstacle;
    return DistanceAndGradient{radius + within.distance, within.gradient};
  };
}

}  // namespace ridgeway::detail
