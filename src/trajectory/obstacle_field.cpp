// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "obstacle_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "planning/layout_box.hpp"

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

  /// Of a voxel's centre; what was found is kept by blocks, as those looked at are mostly of one.
  double at_centre(const VoxelIndex& v) {
    const BlockIndex block = block_of(v);
    if (last_ == nullptr || !(block == last_block_)) {
      const auto part = [](int k) { return static_cast<std::uint64_t>(k) & 0x1fffff; };
      last_ = &known_[part(block.x) | part(block.y) << 21 | part(block.z) << 42];
      last_block_ = block;
    }
    std::int8_t& halves_squared = (*last_)[local_of(v)];
    if (halves_squared == 0) halves_squared = search(v);
    return std::copysign(0.5 * std::sqrt(std::abs(halves_squared)), halves_squared);
  }

  /// Squared half voxels to the border, within 4 kReach^2; below 0 outside.
  std::int8_t search(const VoxelIndex& v) const {
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
    return static_cast<std::int8_t>(inside ? nearest : -static_cast<int>(nearest));
  }

  const EsdfMap& esdf_;
  using Block = std::array<std::int8_t, kBlockVoxels>;  // 0: not looked at
  std::unordered_map<std::uint64_t, Block> known_;
  Block* last_ = nullptr;
  BlockIndex last_block_;
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
    // What the map does not reach has no distances; where it is no obstacle, borders push.
    const bool is_beyond = id == kNoVoxel && esdf.unknown != UnknownPolicy::kObstacle;
    if (is_beyond || (id != kNoVoxel && !esdf.is_obstacle(id) && esdf.distance(id) > enough))
      return {enough, Point::Zero()};
    return interpolate_distance(esdf, p, kReach * s);
  };
  if (esdf.unknown != UnknownPolicy::kIgnore) return from_obstacles;

  return [=, border = std::make_shared<FreeBorder>(esdf)](const Point& p) {
    DistanceAndGradient obstacle = from_obstacles(p);
    if (!has_voxel(p, s)) return obstacle;
    const DistanceAndGradient inside = border->at(p);
    const double scale = margin / kReach;  // the margin begins where the border comes into reach
    if (obstacle.distance <= radius + scale * inside.distance) return obstacle;
    return DistanceAndGradient{radius + scale * inside.distance, inside.gradient * (scale / s)};
  };
}

/// What no flight leaves: its limits, and where unknown space is free the box of the map's blocks.
FlightLimits limits_of_field(const FreeSpace& space) {
  const EsdfMap& esdf = space.map();
  FlightLimits limits = space.limits() != nullptr ? *space.limits() : FlightLimits{};
  if (esdf.unknown != UnknownPolicy::kFree) return limits;
  const LayoutBox box(esdf.layout);
  const double s = esdf.voxel_size;
  FlightLimits within;
  within.keep_in = {s * Point(box.low.x, box.low.y, box.low.z),
                    s * Point(box.high.x + 1, box.high.y + 1, box.high.z + 1)};
  return both_of(limits, within);
}

}  // namespace

DistanceField obstacle_field(const FreeSpace& space, double radius, double margin) {
  DistanceField of_map = field_of_map(space.map(), radius, margin);
  const FlightLimits limits = limits_of_field(space);
  if (!limits.any()) return of_map;
  return [=](const Point& p) {
    DistanceAndGradient obstacle = of_map(p);
    const DistanceAndGradient within = depth_within(limits, p);
    if (obstacle.distance <= radius + within.distance) return obstacle;
    return DistanceAndGradient{radius + within.distance, within.gradient};
  };
}

}  // namespace ridgeway::detail
