// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "common/number_text.hpp"
#include "common/rounding.hpp"
#include "endpoint.hpp"
#include "esdf/known_radius.hpp"
#include "paths/shorten.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::detail {
namespace {

PlanStatus status_of(EndpointStatus status, bool is_start) {
  switch (status) {
    case EndpointStatus::kOutsideMap:
      return is_start ? PlanStatus::kStartOutsideMap : PlanStatus::kGoalOutsideMap;
    case EndpointStatus::kUnknown:
      return is_start ? PlanStatus::kStartUnknown : PlanStatus::kGoalUnknown;
    case EndpointStatus::kInCollision:
      return is_start ? PlanStatus::kStartInCollision : PlanStatus::kGoalInCollision;
    case EndpointStatus::kOutsideLimits:
      return is_start ? PlanStatus::kStartOutsideLimits : PlanStatus::kGoalOutsideLimits;
    case EndpointStatus::kOk:
      break;
  }
  return PlanStatus::kOk;
}

void require_finite(const Point& p, const char* name) {
  if (!p.allFinite())
    throw InputError(name, "is not a finite point", "give three finite coordinates in metres");
}

/// Exact.
double clearance_of(const FreeSpace& space, std::span<const Point> route,
                    const KnownStretch& known) {
  if (std::isinf(known.clearance)) return space.clearance(route);
  const double before = space.clearance(route.first(known.first + 1), known.clearance);
  return space.clearance(route.subspan(known.last), before);
}

}  // namespace

void validate_query(const EsdfMap& esdf, const Point& start, const Point& goal, double radius) {
  require_finite(start, "start");
  require_finite(goal, "goal");
  detail::require_known_radius(esdf, "radius", radius);
}

void validate_robot_height(double height) {
  constexpr double kHighest = 1e6;
  if (!(height >= 0.0 && height <= kHighest))
    throw InputError("robot_height", "is " + number_text(height),
                     "give metres up to 1e6, or 0 for a robot that is a sphere");
}

void require_height_counts(const EsdfMap& esdf, double height) {
  if (esdf.planar && height > 0.0)
    throw InputError(
        "robot_height", "does not count in a plane",
        "leave it out: the heights that it fills are those that the map was flattened from");
}

QueryEnds find_ends(const FreeSpace& space, const Point& start, const Point& goal, double radius) {
  const Endpoint from = find_endpoint(space, start, radius);
  if (from.status != EndpointStatus::kOk) return {.status = status_of(from.status, true)};
  const Endpoint to = find_endpoint(space, goal, radius);
  return {status_of(to.status, false), from.voxel, to.voxel};
}

bool may_go_straight(PlanStatus refused, const FreeSpace& space, const Point& start,
                     const Point& goal, double radius) {
  return (refused == PlanStatus::kStartInCollision || refused == PlanStatus::kGoalInCollision) &&
         space.is_free(start, goal, radius);
}

void drop_repeated(std::vector<Point>& path) {
  const Point goal = path.back();
  path.erase(std::unique(path.begin(), path.end()), path.end());
  if (path.size() == 1) path.push_back(goal);
}

FlightLimits limits_of(const EsdfMap& esdf, const FlightLimits& limits_world) {
  if (!limits_world.any()) return esdf.limits;
  FlightLimits limits = both_of(esdf.limits, limits_in_local(esdf, limits_world));
  require_room(esdf, limits);
  return limits;
}

double within_bound(double length, double bound) {
  if (bound > 0.0) return std::max(length / bound, 1.0);
  return length > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
}

double length_over_bound(std::span<const Point> path) {
  return within_bound(length_of(path), (path.back() - path.front()).norm());
}

void describe(const FreeSpace& space, const KnownStretch& known, PlanResult& result) {
  result.length = length_of(result.waypoints);
  result.within = length_over_bound(result.waypoints);
  result.clearance = clearance_of(space, result.waypoints, known);
}

bool is_verified(const EsdfMap& esdf, const FreeSpace& space, const PlanResult& result,
                 double radius) {
  // Nothing that is called a path may be none: what is empty has no clearance that could be missed.
  if (result.waypoints.size() < 2 || !std::isfinite(result.length)) return false;
  if (!is_as_wide(result.clearance, space.inner_radius(radius))) return false;
  for (std::size_t i = 1; !space.is_for_sphere() && i < result.waypoints.size(); ++i)
    if (!space.is_free(result.waypoints[i - 1], result.waypoints[i], radius)) return false;
  if (!space.is_within_limits(result.waypoints)) return false;
  if (esdf.unknown == UnknownPolicy::kObstacle) return true;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i)
    if (!space.is_known_free(result.waypoints[i - 1], result.waypoints[i])) return false;
  return true;
}

Point place_in_local(const EsdfMap& esdf, const Point& point_world, double radius) {
  constexpr double kExact = 1e-10;  // of the radius: a tenth of what free means leaves for rounding
  Point place = flight_place(esdf, point_world);
  const double rounding =
      2.0 * std::numeric_limits<double>::epsilon() * point_world.cwiseAbs().maxCoeff();
  if (esdf.origin == VoxelIndex{} || !(rounding > kExact * radius && rounding < 1e-3 * radius) ||
      find_endpoint(esdf, place, radius).status != EndpointStatus::kInCollision)
    return place;
  const FreeSpace space(esdf);
  for (int direction = 0; direction < 27; ++direction) {
    const VoxelIndex o = offset_of(direction);
    Point beside = place + rounding * Point(o.x, o.y, o.z);
    if (space.is_free(beside, radius)) return beside;
  }
  return place;
}

void move_to_world(const EsdfMap& esdf, const Point& start_world, const Point& goal_world,
                   PlanResult& result) {
  for (Moved* moved : {&result.moved_start, &result.moved_goal})
    if (moved->distance > 0.0) moved->place = to_world(esdf, moved->place);
  if (result.waypoints.empty()) return;
  for (Point& p : result.waypoints) p = to_world(esdf, p);
  const auto put = [&](Point& waypoint, const Point& asked, const Moved& moved) {
    if (moved.distance > 0.0) return;
    const double height = waypoint.z();
    waypoint = asked;
    if (esdf.planar) waypoint.z() = height;
  };
  put(result.waypoints.front(), start_world, result.moved_start);
  put(result.waypoints.back(), goal_world, result.moved_goal);
}

}  // namespace ridgeway::detail
