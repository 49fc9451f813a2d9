// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/plan.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "answering.hpp"
#include "common/number_text.hpp"
#include "endpoint.hpp"
#include "escape.hpp"
#include "esdf/cylinder_room.hpp"
#include "paths/deadline.hpp"
#include "query.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "snap.hpp"

namespace ridgeway {

using detail::Deadline;
using detail::plan_between;
using detail::seconds_now;

void PlanConfig::validate() const {
  validate_planner(planner);
  if (is_sampling(planner))
    throw InputError("planner", "is " + std::string(name_of(planner)) + ", which samples",
                     "call plan_by_sampling");
  if (radius && !(*radius > 0.0 && std::isfinite(*radius)))
    throw InputError("radius", "is " + number_text(*radius),
                     "give the robot's radius in metres, above 0");
  limits.validate();
  detail::validate_robot_height(robot_height);
  if (escape && robot_height > 0.0)
    throw InputError("escape", "is of robots that are spheres", "leave out robot_height");
  if (!(snap >= 0.0 && std::isfinite(snap)))
    throw InputError("snap", "is " + number_text(snap), "give metres, 0 for none");
  if (!(time_limit > 0.0))
    throw InputError("time_limit", "is " + number_text(time_limit),
                     "give seconds above 0, or leave it out for no limit");
  if (!(within == 0.0 || (within >= 1.0 && std::isfinite(within))))
    throw InputError("within", "is " + number_text(within),
                     "give a factor of 1 and more, such as 1.05, or 0 to leave it open");
  // Far beyond what is of use, and no cost of a path overflows.
  constexpr double kMostPreferClearance = 1e6;
  if (!(prefer_clearance >= 0.0 && prefer_clearance <= kMostPreferClearance))
    throw InputError("prefer_clearance", "is " + number_text(prefer_clearance),
                     "give a number from 0, for shortest paths, to about 10; at most 1e6");
}

namespace {

/// Where a path begins that has to leave a place too close to an obstacle first; not found where it
/// has not, or cannot.
detail::EscapeResult escape_from(const FreeSpace& space, const Point& point, double radius,
                                 const Deadline& deadline) {
  if (detail::find_endpoint(space, point, radius).status != detail::EndpointStatus::kInCollision)
    return {};
  return detail::find_escape(space, point, radius, deadline);
}

PlanResult plan_with_escapes(const Roadmap& roadmap, const FreeSpace& space, const Point& start,
                             const Point& goal, double radius, const PlanConfig& config,
                             const Deadline& deadline) {
  const double began = seconds_now();
  const EsdfMap& esdf = roadmap.esdf;
  const detail::EscapeResult out = escape_from(space, start, radius, deadline);
  const detail::EscapeResult in = escape_from(space, goal, radius, deadline);
  PlanResult result;
  if (out.status == detail::SearchStatus::kTimeout || in.status == detail::SearchStatus::kTimeout) {
    result.status = PlanStatus::kTimeout;
    result.unknown = esdf.unknown;
    result.seconds.total = seconds_now() - began;
    return result;
  }
  const auto place_of = [](const detail::EscapeResult& escape) {
    return escape.status == detail::SearchStatus::kFound ? std::optional(escape.place)
                                                         : std::nullopt;
  };
  const std::optional<Point> from = place_of(out), to = place_of(in);
  result = plan_between(roadmap, space, from.value_or(start), to.value_or(goal), radius, config,
                        deadline);
  if (result.ok() && (from || to)) {
    std::vector<Point>& path = result.waypoints;
    if (from && to && *from == *to) path = {*from};
    if (from) {
      path.insert(path.begin(), start);
      result.escape_start = {(*from - start).norm(), space.clearance(start, *from)};
    }
    if (to) {
      path.push_back(goal);
      result.escape_goal = {(*to - goal).norm(), space.clearance(goal, *to)};
    }
    detail::drop_repeated(path);
    const double clearance = result.clearance;
    detail::describe(space, {}, result);
    result.clearance = clearance;
  }
  result.seconds.total = seconds_now() - began;
  return result;
}

}  // namespace

PlanResult detail::plan_locally(const Roadmap& roadmap, const Point& start, const Point& goal,
                                const PlanConfig& config) {
  config.validate();
  const double radius = config.radius.value_or(roadmap.min_clearance);
  validate_query(roadmap.esdf, start, goal, radius);
  require_height_counts(roadmap.esdf, config.robot_height);
  const Deadline deadline(config.time_limit);
  const FlightLimits limits = limits_of(roadmap.esdf, config.limits);
  const double voxel_size = roadmap.esdf.voxel_size;
  CylinderRoom room(roadmap.esdf, radius / voxel_size, 0.5 * config.robot_height / voxel_size);
  const FreeSpace space(FreeSpace(roadmap.esdf, limits, radius, config.robot_height), room);
  const PlanBetween between = [&](const Point& from, const Point& to) {
    return config.escape ? plan_with_escapes(roadmap, space, from, to, radius, config, deadline)
                         : plan_between(roadmap, space, from, to, radius, config, deadline);
  };
  const double began = seconds_now();
  PlanResult result = between(start, goal);
  if (config.snap == 0.0 || !is_refused(result.status)) return result;
  result = plan_snapped(space, start, goal, radius, config.snap, between, result, deadline);
  result.seconds.total = seconds_now() - began;
  return result;
}

PlanResult plan(const Roadmap& roadmap, const Point& start, const Point& goal,
                const PlanConfig& config) {
  const EsdfMap& esdf = roadmap.esdf;
  const double radius = config.radius.value_or(roadmap.min_clearance);
  const Point from = detail::place_in_local(esdf, start, radius);
  const Point to = detail::place_in_local(esdf, goal, radius);
  PlanResult result = detail::plan_locally(roadmap, from, to, config);
  detail::move_to_world(esdf, start, goal, result);
  result.planned_for = {radius, config.robot_height, config.limits};
  return result;
}

PlanResult given_plan(const EsdfMap& esdf, std::vector<Point> waypoints) {
  PlanResult path;
  path.waypoints = std::move(waypoints);
  if (path.waypoints.empty())
    throw InputError("path", "has no waypoint", "give a path of plan, or one of your own");
  path.status = PlanStatus::kOk;
  path.answered_by = Planner::kGiven;
  path.unknown = esdf.unknown;
  std::vector<Point> local;
  for (Point& p : path.waypoints) {
    local.push_back(flight_place(esdf, p));
    if (!has_voxel(local.back(), esdf.voxel_size))
      throw InputError("path", "has a waypoint far outside the map", "give metres, in its frame");
    if (esdf.planar) p = to_world(esdf, local.back());
  }
  path.length = length_of(path.waypoints);
  path.clearance = FreeSpace(esdf).clearance(local);
  path.within = detail::length_over_bound(path.waypoints);
  return path;
}

}  // namespace ridgeway
