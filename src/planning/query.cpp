// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "common/number_text.hpp"
#include "endpoint.hpp"
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
  if (radius > largest_radius(esdf))
    throw InputError("radius " + number_text(radius), "is beyond the distances that the map holds",
                     "build the map with a larger max_distance, or without one");
}

QueryEnds find_ends(const EsdfMap& esdf, const Point& start, const Point& goal, double radius) {
  const Endpoint from = find_endpoint(esdf, start, radius);
  if (from.status != EndpointStatus::kOk) return {.status = status_of(from.status, true)};
  const Endpoint to = find_endpoint(esdf, goal, radius);
  return {status_of(to.status, false), from.voxel, to.voxel};
}

double length_over_bound(std::span<const Point> path) {
  const double straight = (path.back() - path.front()).norm();
  return straight > 0.0 ? std::max(length_of(path) / straight, 1.0) : 1.0;
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
  if (!(result.clearance >= radius * (1.0 - 1e-9))) return false;
  if (esdf.unknown == UnknownPolicy::kObstacle) return true;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i)
    if (!space.is_known_free(result.waypoints[i - 1], result.waypoints[i])) return false;
  return true;
}

Point place_in_local(const EsdfMap& esdf, const Point& point_world, double radius) {
  constexpr double kExact = 1e-10;  // of the radius: a tenth of what free means leaves for rounding
  const Point place = to_local(esdf, point_world);
  const double rounding =
      2.0 * std::numeric_limits<double>::epsilon() * point_world.cwiseAbs().maxCoeff();
  if (esdf.origin == VoxelIndex{} || !(rounding > kExact * radius && rounding < 1e-3 * radius) ||
      find_endpoint(esdf, place, radius).status != EndpointStatus::kInCollision)
    return place;
  const FreeSpace space(esdf);
  for (int direction = 0; direction < 27; ++direction) {
    const VoxelIndex o = offset_of(direction);
    const Point beside = place + rounding * Point(o.x, o.y, o.z);
    if (space.is_free(beside, radius)) return beside;
  }
  return place;
}

void move_to_world(const EsdfMap& esdf, const Point& start_world, const Point& goal_world,
                   PlanResult& result) {
  if (result.waypoints.empty()) return;
  for (Point& p : result.waypoints) p = to_world(esdf, p);
  result.waypoints.front() = start_world;
  result.waypoints.back() = goal_world;
}

}  // namespace ridgeway::detail
