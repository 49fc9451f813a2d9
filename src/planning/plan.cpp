// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/plan.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "common/number_text.hpp"
#include "endpoint.hpp"
#include "escape.hpp"
#include "paths/deadline.hpp"
#include "paths/shorten.hpp"
#include "query.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "route.hpp"
#include "snap.hpp"
#include "tangent_path.hpp"
#include "tightest.hpp"

namespace ridgeway {

using detail::Deadline;
using detail::KnownStretch;
using detail::seconds_now;

double largest_radius(const EsdfMap& esdf) { return esdf.max_distance - 2.0 * esdf.voxel_size; }

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
  // Far beyond what is of use, and no cost of a path overflows.
  constexpr double kMostPreferClearance = 1e6;
  if (!(prefer_clearance >= 0.0 && prefer_clearance <= kMostPreferClearance))
    throw InputError("prefer_clearance", "is " + number_text(prefer_clearance),
                     "give a number from 0, for shortest paths, to about 10; at most 1e6");
}

namespace {

/// Between places where the robot fits.
PlanResult plan_between(const Roadmap& roadmap, const FreeSpace& space, const Point& start,
                        const Point& goal, double radius, const PlanConfig& config,
                        const Deadline& deadline) {
  const EsdfMap& esdf = roadmap.esdf;
  const double began = seconds_now();
  PlanResult result;
  result.unknown = esdf.unknown;
  const auto finish = [&](PlanStatus status) {
    result.status = status;
    result.seconds.total = seconds_now() - began;
    return std::move(result);
  };
  if (space.inner_radius(radius) < roadmap.min_clearance * (1.0 - 1e-9))
    return finish(PlanStatus::kRadiusTooSmall);
  const detail::QueryEnds ends = detail::find_ends(space, start, goal, radius);
  if (ends.status != PlanStatus::kOk) return finish(ends.status);

  if (((config.shorten && config.prefer_clearance == 0.0) || start == goal) &&
      space.is_free(start, goal, radius)) {  // nothing is shorter
    result.answered_by = config.planner;
    result.waypoints = {start, goal};
    detail::describe(space, {}, result);
    return finish(PlanStatus::kOk);
  }
  const detail::RouteQuery query{ends.from, ends.to, start, goal, radius, config.prefer_clearance};
  const bool may_ask_tangents = config.shorten && space.is_for_sphere() &&
                                config.planner == Planner::kGraph &&
                                radius <= roadmap.tangents.graph.min_clearance * (1.0 + 1e-9);
  detail::TangentPath tangents;
  if (may_ask_tangents)
    tangents = detail::plan_tangents(roadmap.tangents, esdf, space, query,
                                     config.quick && config.prefer_clearance == 0.0, deadline);
  if (!space.is_within_limits(tangents.waypoints)) tangents = {};
  result.seconds.search = tangents.search_seconds;
  result.seconds.shorten = tangents.shorten_seconds;
  if (tangents.will_do && config.prefer_clearance == 0.0) {
    result.waypoints = std::move(tangents.waypoints);
    detail::describe(space, tangents.known, result);
    if (detail::is_verified(esdf, space, result, radius)) return finish(PlanStatus::kOk);
    tangents.waypoints.clear();  // of no more use
  }
  detail::RouteResult found = detail::find_route(roadmap, space, query, config.planner, deadline);
  result.seconds.attach = found.attach_seconds;
  result.seconds.search += found.search_seconds;
  result.answered_by = found.answered_by;
  if (found.status == detail::SearchStatus::kTimeout) return finish(PlanStatus::kTimeout);
  const double shortening = seconds_now();
  if (found.status == detail::SearchStatus::kNoRoute) {
    // The lattice knows no way, but a straight look may slip through what it cannot resolve.
    if (!space.is_free(start, goal, radius)) return finish(PlanStatus::kNoRoute);
    result.waypoints = {start, goal};
  } else {
    result.waypoints = config.shorten ? detail::tightest(roadmap, space, found, query,
                                                         std::move(tangents.waypoints), deadline)
                                      : found.route;
  }
  result.seconds.shorten += seconds_now() - shortening;
  detail::describe(space, config.shorten ? KnownStretch{} : found.known, result);
  if (detail::is_verified(esdf, space, result, radius)) return finish(PlanStatus::kOk);
  // What the search found holds move by move, whatever became of it since.
  result.waypoints = std::move(found.route);
  if (!result.waypoints.empty()) {
    detail::describe(space, found.known, result);
    if (detail::is_verified(esdf, space, result, radius)) return finish(PlanStatus::kOk);
  }
  result.waypoints.clear();
  return finish(PlanStatus::kNoRoute);
}

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
  const FreeSpace space(roadmap.esdf, limits, radius, config.robot_height);
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
  return result;
}

}  // namespace ridgeway
