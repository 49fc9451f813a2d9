// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "deadline.hpp"
#include "endpoint.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "route.hpp"
#include "shorten.hpp"

namespace ridgeway {
namespace {

using detail::Deadline;
using detail::EndpointStatus;
using detail::Route;
using detail::seconds_now;

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

constexpr double kUnknownStep = 8.0;  // voxels between looks at what the path borders

void require_finite(const Point& p, const char* name) {
  if (!p.allFinite())
    throw InputError(name, "is not a finite point", "give three finite coordinates in metres");
}

/// Exact; of the graph's edges the clearance is known.
double clearance_of(const FreeSpace& space, std::span<const Point> route,
                    const detail::EdgeStretch& edges) {
  const double before = space.clearance(route.first(edges.first + 1), edges.clearance);
  return space.clearance(route.subspan(edges.last), before);
}

/// Length, clearance and the share that borders the unknown.
void describe(const EsdfMap& esdf, const FreeSpace& space, const detail::EdgeStretch& edges,
              PlanResult& result) {
  result.length = detail::length_of(result.waypoints);
  result.clearance = clearance_of(space, result.waypoints, edges);
  VoxelFinder finder(esdf.layout);
  double bordering = 0.0;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i) {
    const Point& a = result.waypoints[i - 1];
    const Point& b = result.waypoints[i];
    const double length = (b - a).norm();
    const int pieces = 1 + static_cast<int>(length / (kUnknownStep * esdf.voxel_size));
    int unknown = 0;
    for (int k = 0; k < pieces; ++k) {
      const VoxelIndex v = voxel_at(a + (b - a) * ((k + 0.5) / pieces), esdf.voxel_size);
      const VoxelId id = finder.find(v);
      if (id == kNoVoxel || esdf.squared[id] == kNoSite) continue;
      const SiteOffset o = esdf.site[id];
      const VoxelId site = finder.find(v + VoxelIndex{o.x, o.y, o.z});
      unknown += site == kNoVoxel || esdf.state[site] == VoxelState::kUnknown;
    }
    bordering += length * unknown / pieces;
  }
  result.unknown_share = result.length > 0.0 ? bordering / result.length : 0.0;
}

/// No path leaves unverified: its clearance, measured along every segment (along the graph's edges
/// when they were made or loaded), must be the radius, and where unknown space is no obstacle it
/// must keep to what is known.
bool is_verified(const EsdfMap& esdf, const FreeSpace& space, const PlanResult& result,
                 double radius) {
  if (result.clearance < radius * (1.0 - 1e-9)) return false;
  if (esdf.unknown == UnknownPolicy::kObstacle) return true;
  for (std::size_t i = 1; i < result.waypoints.size(); ++i)
    if (!space.is_known_free(result.waypoints[i - 1], result.waypoints[i])) return false;
  return true;
}

}  // namespace

std::string_view name_of(PlanStatus status) {
  constexpr std::array<std::string_view, 10> kNames{"ok",
                                                    "start_outside_map",
                                                    "start_unknown",
                                                    "start_in_collision",
                                                    "goal_outside_map",
                                                    "goal_unknown",
                                                    "goal_in_collision",
                                                    "no_route",
                                                    "radius_too_small",
                                                    "timeout"};
  return kNames[static_cast<std::size_t>(status)];
}

std::string_view name_of(Planner planner) {
  constexpr std::array<std::string_view, 3> kNames{"graph", "diagram", "esdf"};
  return kNames[static_cast<std::size_t>(planner)];
}

double largest_radius(const EsdfMap& esdf) { return esdf.max_distance - 2.0 * esdf.voxel_size; }

void PlanConfig::validate() const {
  if (radius && !(*radius > 0.0 && std::isfinite(*radius)))
    throw InputError("radius", "is " + number_text(*radius),
                     "give the robot's radius in metres, above 0");
  if (!(time_limit > 0.0))
    throw InputError("time_limit", "is " + number_text(time_limit),
                     "give seconds above 0, or leave it out for no limit");
}

PlanResult plan(const Roadmap& roadmap, const Point& start, const Point& goal,
                const PlanConfig& config) {
  config.validate();
  require_finite(start, "start");
  require_finite(goal, "goal");
  const EsdfMap& esdf = roadmap.esdf;
  const double radius = config.radius.value_or(roadmap.min_clearance);
  if (radius > largest_radius(esdf))
    throw InputError("radius " + number_text(radius), "is beyond the distances that the map holds",
                     "build the map with a larger --max-distance, or without one");
  const Deadline deadline(config.time_limit);
  const double began = seconds_now();
  PlanResult result;
  const auto finish = [&](PlanStatus status) {
    result.status = status;
    result.seconds.total = seconds_now() - began;
    return result;
  };
  if (radius < roadmap.min_clearance * (1.0 - 1e-9)) return finish(PlanStatus::kRadiusTooSmall);
  const detail::Endpoint from = detail::find_endpoint(esdf, start, radius);
  if (from.status != EndpointStatus::kOk) return finish(status_of(from.status, true));
  const detail::Endpoint to = detail::find_endpoint(esdf, goal, radius);
  if (to.status != EndpointStatus::kOk) return finish(status_of(to.status, false));

  const FreeSpace space(esdf);
  if ((config.shorten || start == goal) &&
      space.is_free(start, goal, radius)) {  // nothing is shorter
    result.answered_by = config.planner;
    result.waypoints = {start, goal};
    describe(esdf, space, {}, result);
    return finish(PlanStatus::kOk);
  }
  const detail::RouteQuery query{from.voxel, to.voxel, start, goal, radius};
  detail::RouteResult found = detail::find_route(roadmap, query, config.planner, deadline);
  result.seconds.attach = found.attach_seconds;
  result.seconds.search = found.search_seconds;
  result.answered_by = found.answered_by;
  if (found.status == detail::SearchStatus::kTimeout) return finish(PlanStatus::kTimeout);
  const double shortening = seconds_now();
  if (found.status == detail::SearchStatus::kNoRoute) {
    // The lattice knows no way, but a straight look may slip through what it cannot resolve.
    if (!space.is_free(start, goal, radius)) return finish(PlanStatus::kNoRoute);
    result.waypoints = {start, goal};
  } else {
    result.waypoints =
        config.shorten ? detail::tightest(esdf, space, found, radius, deadline) : found.route;
  }
  result.seconds.shorten = seconds_now() - shortening;
  describe(esdf, space, config.shorten ? detail::EdgeStretch{} : found.edges, result);
  if (is_verified(esdf, space, result, radius)) return finish(PlanStatus::kOk);
  // What the search found holds move by move, whatever became of it since.
  result.waypoints = std::move(found.route);
  if (!result.waypoints.empty()) {
    describe(esdf, space, found.edges, result);
    if (is_verified(esdf, space, result, radius)) return finish(PlanStatus::kOk);
  }
  result.waypoints.clear();
  return finish(PlanStatus::kNoRoute);
}

}  // namespace ridgeway
