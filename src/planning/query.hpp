// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::detail {

// What every planner does with a query before its search, and with a path after it. All points are
// in the map's local frame: the public functions come from the world and go back to it.

/// Throws InputError where a point is no number, or the radius is larger than the map knows
/// distances for.
void validate_query(const EsdfMap& esdf, const Point& start, const Point& goal, double radius);

/// The traversable voxels that start and goal join, or which of the two does not, and why.
struct QueryEnds {
  PlanStatus status = PlanStatus::kOk;
  VoxelId from = kNoVoxel, to = kNoVoxel;
};
QueryEnds find_ends(const FreeSpace& space, const Point& start, const Point& goal, double radius);

/// Robots fit in places where no voxel's centre is free: whether one whose ends were refused for
/// that sees its goal all the same.
bool may_go_straight(PlanStatus refused, const FreeSpace& space, const Point& start,
                     const Point& goal, double radius);

/// Drops waypoints that come twice in a row, but for the goal of a path of one place.
void drop_repeated(std::vector<Point>& path);

/// The limits of a query (world frame) and those of the map, in its local frame. Throws InputError
/// where they are bad, or hold no voxel.
FlightLimits limits_of(const EsdfMap& esdf, const FlightLimits& limits_world);

/// Throws InputError for a height that no upright cylinder has (0: it is none), or one in a plane.
void validate_robot_height(double height);
void require_height_counts(const EsdfMap& esdf, double height);

/// Waypoints of a route between which the clearance is known, by moves between voxels and the
/// graph's edges; none if first == last.
struct KnownStretch {
  std::size_t first = 0, last = 0;
  double clearance = std::numeric_limits<double>::infinity();  ///< smallest, metres
};

/// A length over a bound that no shorter path is below; 1 and more, infinite where the bound is 0
/// and the length is not.
double within_bound(double length, double bound);
/// The same of a path and the straight line between its ends.
double length_over_bound(std::span<const Point> path);

/// Length, clearance and bound of the result's waypoints.
void describe(const FreeSpace& space, const KnownStretch& known, PlanResult& result);

/// No path leaves unverified: there must be one, its length must be finite, its clearance, measured
/// along every segment (along the graph's edges when they were made or loaded), must be the radius,
/// it must be within the limits, and where unknown space is no obstacle it must keep to what is
/// known. The result must have been
/// described.
bool is_verified(const EsdfMap& esdf, const FreeSpace& space, const PlanResult& result,
                 double radius);

/// A start or goal of the world in the local frame. Where the world's coordinates are so large that
/// their rounding counts, one that is within it of a place where a sphere of the radius fits is
/// taken to mean that place: waypoints of paths close around obstacles are places to plan from.
Point place_in_local(const EsdfMap& esdf, const Point& point_world, double radius);

/// plan() between points of the local frame, with waypoints there.
PlanResult plan_locally(const Roadmap& roadmap, const Point& start, const Point& goal,
                        const PlanConfig& config);

/// Waypoints moved into the world; the first and the last become the points that were asked for, to
/// the bit.
void move_to_world(const EsdfMap& esdf, const Point& start_world, const Point& goal_world,
                   PlanResult& result);

}  // namespace ridgeway::detail
