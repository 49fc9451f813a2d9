// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {

namespace detail {
class CylinderRoom;
}

/// The one predicate that decides everywhere what is free at a radius: D(x), the exact distance
/// from a point to the closed obstacle cubes, and its minimum along straight segments. Trilinear
/// interpolation can overestimate D and is never asked here.
///
/// Free means D >= radius (1 - 1e-9). Under UnknownPolicy::kIgnore a point must also lie in a
/// known-free voxel; shared faces, edges and corners belong to every voxel that touches them.
///
/// How it is fast: D^2(x) - |x|^2 is concave, so distances at voxel centres bound D from below;
/// only where that does not decide are the obstacles near the place looked at one by one.
/// A robot may be an upright cylinder in place of a sphere: then a place is free where no obstacle
/// cube shares volume with it, exactly, along whole segments too, and distances are still those of
/// its centre. `radius` everywhere is the cylinder's; asked for a radius that is larger by some
/// margin its height grows by as much at both ends, for a smaller one it shrinks in proportion.
/// Where flights are limited, free also means within the limits; distances and clearances are to
/// obstacles alone.
/// All points are in the map's local frame: take flight_place(esdf, point) of those of the world.
/// One that is no number, or too far out for a voxel (has_voxel), is in an obstacle, and nothing is
/// free for a radius below 0. A view: the EsdfMap and the limits must outlive it. Thread-safe.
class FreeSpace {
 public:
  /// Within the limits of the map, where it has some.
  FreeSpace(const EsdfMap& esdf) : FreeSpace(esdf, esdf.limits) {}  // NOLINT: it is one
  /// Within other limits (local frame), which should hold where those of the map hold.
  FreeSpace(const EsdfMap& esdf, const FlightLimits& limits)
      : esdf_(esdf), limits_(limits.any() ? &limits : nullptr) {}
  /// Maps and limits that are gone once it is made are refused.
  template <typename... Rest>
  FreeSpace(const EsdfMap&&, const Rest&...) = delete;
  /// The same.
  template <typename... Rest>
  FreeSpace(const EsdfMap&, const FlightLimits&&, const Rest&...) = delete;
  /// For an upright cylinder of a radius and a height, metres; a sphere where the height is 0.
  FreeSpace(const EsdfMap& esdf, const FlightLimits& limits, double radius, double height)
      : esdf_(esdf),
        limits_(limits.any() ? &limits : nullptr),
        radius_(radius),
        height_(height),
        outer_radius_(std::hypot(radius, 0.5 * height)) {}
  /// The same as another for one thread, which asks `room`, of the same cylinder, for moves between
  /// voxels: quicker where there are many.
  FreeSpace(const FreeSpace& space, detail::CylinderRoom& room) : FreeSpace(space) {
    room_ = &room;
  }

  /// The distances that it looks at.
  const EsdfMap& map() const { return esdf_; }

  const FlightLimits* limits() const { return limits_; }  ///< null where there are none
  /// Whether the robot is one; otherwise an upright cylinder.
  bool is_for_sphere() const { return height_ == 0.0; }
  /// Whether the robot is no sphere, or limits are not those of the map, for which its roadmap was
  /// made.
  bool is_narrowed() const {
    return !is_for_sphere() || (limits_ != nullptr && !(*limits_ == esdf_.limits));
  }
  /// Radius, metres, of the largest sphere that is in the robot, and of the smallest that it is in,
  /// both around its centre: what is not free for the one is not for the robot, what is free for
  /// the other is.
  double inner_radius(double radius) const {
    return is_for_sphere() ? radius : std::min(radius, half_height(radius));
  }
  /// See inner_radius; metres.
  double outer_radius(double radius) const {
    return is_for_sphere() ? radius : std::hypot(radius, half_height(radius));
  }
  /// Whether all of a segment, or a path of them, is within the limits.
  bool is_within_limits(const Point& a, const Point& b) const {
    return limits_ == nullptr || limits_->allow(a, b);
  }
  /// The same of a path of straight segments.
  bool is_within_limits(std::span<const Point> path) const {
    return limits_ == nullptr || limits_->allow(path);
  }
  /// Whether a voxel is. Moves between neighbours that are stay within the limits.
  bool is_within_limits(VoxelId id) const {
    return limits_ == nullptr || limits_->allow_voxel(esdf_.layout.index_of(id), esdf_.voxel_size);
  }
  /// The nearest place that is in the box that limits keep in.
  Point nearest_within(const Point& p) const {
    return limits_ == nullptr ? p : limits_->nearest_within(p);
  }
  /// Whether a curve is within that departs from a segment by no more than a margin, metres, and
  /// lies in the hull of points.
  template <typename Points>
  bool is_within_limits(const Points& hull, const Point& a, const Point& b, double margin) const {
    if (limits_ == nullptr) return true;
    for (Eigen::Index i = 0; i < hull.cols(); ++i)
      if (!limits_->keeps_in(hull.col(i))) return false;
    return limits_->allow(a, b, margin);
  }

  /// D at a point, metres; 0 in an obstacle. Where all obstacles are farther than max_distance, or
  /// than kFarthestSite voxels, max_distance or more (infinite where there is no limit). Where the
  /// map has no block and unknown space is no obstacle, D is found only if there is a max_distance:
  /// otherwise it is infinite, though nothing is free there.
  double distance(const Point& p) const;

  /// Smallest D along a segment, metres; for one outside the map's blocks as distance().
  double clearance(const Point& a, const Point& b) const;

  /// Smallest D along a path of straight segments (at least one point), metres, or `at_most` where
  /// it is larger: then only what is narrower is looked at closely.
  double clearance(std::span<const Point> path,
                   double at_most = std::numeric_limits<double>::infinity()) const;

  /// Whether a sphere of a radius, or the cylinder, fits at a point.
  bool is_free(const Point& p, double radius) const;

  /// Whether a sphere of a radius, or the cylinder, can move along a segment.
  bool is_free(const Point& a, const Point& b, double radius) const;

  /// Whether a segment is free by the bounds from voxel centres alone, without a look at single
  /// obstacles: true is certain, false may be free, by up to about half a voxel close to obstacles
  /// and less farther off. Much cheaper; for searches that try many segments and keep few.
  bool is_clearly_free(const Point& a, const Point& b, double radius) const;

  /// How far from `a` towards `b` a sphere of a radius, or the cylinder, can certainly move: |b -
  /// a| if all the way, else up to a voxel short.
  double free_length(const Point& a, const Point& b, double radius) const;

  /// The same by the bounds from voxel centres alone, as is_clearly_free() has them: less close to
  /// obstacles, and much cheaper along them.
  double clear_length(const Point& a, const Point& b, double radius) const;

  /// Of the site of the voxel that holds p, the point nearest to p: near, but not always on the
  /// obstacle that is nearest to p. Nothing where all obstacles are farther than max_distance from
  /// that voxel, or p is outside the map.
  std::optional<Point> near_obstacle(const Point& p) const;

  /// Whether all of a segment lies in known-free voxels, or where unknown space is free in voxels
  /// that are not occupied.
  bool is_known_free(const Point& a, const Point& b) const;

  /// Whether the robot can move from the centre of a free voxel to a free 26-neighbour of it, in
  /// a direction (voxel/neighbourhood.hpp), both within the limits. `threshold`:
  /// least_clearance(inner_radius(radius), voxel_size).
  bool move_is_free(VoxelId from, VoxelId to, int direction, SquaredHalves threshold) const {
    const SquaredHalves a = esdf_.squared[from], b = esdf_.squared[to];
    if (a < threshold || b < threshold) return false;
    if (!is_for_sphere()) return cylinder_fits(from, to);
    const SquaredHalves bound = move_bound(a, b, squared_length(direction));
    if (bound >= threshold) return true;
    constexpr SquaredHalves kNothing(0.0), kHalfVoxel(1.0);
    if (threshold > kNothing && threshold <= kHalfVoxel)
      return touches_no_obstacle(from, direction);
    return slow_move_clearance(from, to, direction, threshold) >= threshold;
  }

  /// 4 D^2 / s^2 at the narrowest place of that move. Moves across a face never dip below their
  /// ends.
  SquaredHalves move_clearance(VoxelId from, VoxelId to, int direction) const {
    const SquaredHalves a = esdf_.squared[from], b = esdf_.squared[to];
    const SquaredHalves low = a < b ? a : b;
    if (move_bound(a, b, squared_length(direction)) >= low) return low;
    return slow_move_clearance(from, to, direction, low);
  }

  /// Lower bound of 4 D^2 / s^2 between two voxel centres where it is a and b, L2 voxels^2 apart:
  /// the minimum over t of (1-t) a + t b - 4 t (1-t) L2; exact for L2 = 1.
  static SquaredHalves move_bound(SquaredHalves a, SquaredHalves b, int L2) {
    const SquaredHalves low = a < b ? a : b;
    const double rise = a < b ? b.value - a.value : a.value - b.value;
    if (L2 == 1 || rise >= 4.0 * L2) return low;
    return SquaredHalves(0.5 * (a.value + b.value) - L2 - rise * rise / (16.0 * L2));
  }

 private:
  /// Whether the voxels that a move between free ones touches beside these, at an edge or a corner,
  /// are none. All others are half a voxel away from it or more.
  bool touches_no_obstacle(VoxelId from, int direction) const;
  SquaredHalves slow_move_clearance(VoxelId from, VoxelId to, int direction,
                                    SquaredHalves enough) const;

  double half_height(double radius) const {
    return radius >= radius_ ? 0.5 * height_ + radius - radius_ : 0.5 * height_ * radius / radius_;
  }
  bool cylinder_fits(VoxelId from, VoxelId to) const;
  /// Of free_length() and clear_length(): what a march is to find (detail::Wanted).
  template <auto wanted>
  double length_until(const Point& a, const Point& b, double radius) const;

  const EsdfMap& esdf_;
  const FlightLimits* limits_;                               // null where there are none
  double radius_ = 0.0, height_ = 0.0, outer_radius_ = 0.0;  // of a cylinder
  detail::CylinderRoom* room_ = nullptr;
};

}  // namespace ridgeway
