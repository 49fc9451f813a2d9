// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/many_goals.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "common/number_text.hpp"
#include "common/rounding.hpp"
#include "endpoint.hpp"
#include "paths/shorten.hpp"
#include "query.hpp"
#include "ridgeway/common/error.hpp"
#include "roadmap/attach_way.hpp"
#include "roadmap/graph_search.hpp"
#include "voxel_route.hpp"

namespace ridgeway {
namespace {

/// Where a point joins the graph, and the length of the way there.
struct Entry {
  VoxelId voxel = kNoVoxel;
  detail::AttachWay way;
  double length = 0.0;
};

/// `point`: in the local frame.
Entry find_entry(const Roadmap& roadmap, const Point& point, double radius) {
  Entry entry;
  entry.voxel = detail::find_endpoint(roadmap.esdf, point, radius).voxel;
  if (entry.voxel == kNoVoxel) return entry;
  entry.way = detail::follow_attach(roadmap, entry.voxel, radius);
  detail::Route route = detail::route_over_voxels(
      roadmap.esdf, {entry.voxel, entry.voxel, point, point, radius}, entry.way.voxels);
  route.pop_back();  // the point again
  entry.length = length_of(route);
  return entry;
}

}  // namespace

std::vector<double> distances_to_goals(const Roadmap& roadmap, const Point& start_world,
                                       std::span<const Point> goals_world,
                                       std::optional<double> radius) {
  PlanConfig{.radius = radius}.validate();
  const double r = radius.value_or(roadmap.min_clearance);
  const Point start = detail::place_in_local(roadmap.esdf, start_world, r);
  std::vector<Point> goals;
  for (const Point& goal : goals_world) {
    goals.push_back(detail::place_in_local(roadmap.esdf, goal, r));
    detail::validate_query(roadmap.esdf, start, goals.back(), r);
  }
  std::vector<double> distances(goals.size(), std::numeric_limits<double>::infinity());
  if (!detail::is_as_wide(r, roadmap.min_clearance))
    throw InputError("radius",
                     "is " + number_text(r) + ", below the " + number_text(roadmap.min_clearance) +
                         " that the roadmap was built for",
                     "give that or more, or build with a smaller min_clearance");
  const Entry from = find_entry(roadmap, start, r);
  if (from.voxel == kNoVoxel) return distances;
  std::vector<double> along;  // the graph, to each vertex
  if (from.way.reached()) along = lengths_from(roadmap.graph, {{from.way.vertex, from.length}}, r);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const Entry to = find_entry(roadmap, goals[i], r);
    if (to.voxel == kNoVoxel) continue;
    if (start == goals[i])
      distances[i] = 0.0;
    else if (from.way.voxels.back() == to.way.voxels.back())
      distances[i] = length_of(
          detail::route_over_voxels(roadmap.esdf, {from.voxel, to.voxel, start, goals[i], r},
                                    detail::join_ways(from.way.voxels, to.way.voxels)));
    else if (from.way.reached() && to.way.reached())
      distances[i] = along[number(to.way.vertex)] + to.length;
  }
  return distances;
}

std::vector<GoalPlan> plan_to_many(const Roadmap& roadmap, const Point& start,
                                   std::span<const Point> goals, const PlanConfig& config) {
  config.validate();
  const std::vector<double> distances = distances_to_goals(roadmap, start, goals, config.radius);
  std::vector<GoalPlan> plans;
  for (std::size_t i = 0; i < goals.size(); ++i)
    plans.push_back({distances[i], plan(roadmap, start, goals[i], config)});
  return plans;
}

NearestGoal plan_to_nearest(const Roadmap& roadmap, const Point& start,
                            std::span<const Point> goals, const PlanConfig& config) {
  config.validate();
  if (goals.empty()) throw InputError("goals", "are none", "give at least one");
  const std::vector<double> distances = distances_to_goals(roadmap, start, goals, config.radius);
  std::vector<std::size_t> order(goals.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  NearestGoal nearest;
  nearest.statuses.resize(goals.size());
  std::optional<PlanResult> refusal;  // of the first goal
  for (const std::size_t i : order) {
    const double straight =
        (flight_place(roadmap.esdf, goals[i]) - flight_place(roadmap.esdf, start)).norm();
    if (nearest.goal && straight - 2.0 * config.snap > nearest.plan.length) continue;
    PlanResult result = plan(roadmap, start, goals[i], config);
    nearest.statuses[i] = result.status;
    if (i == 0 && !result.ok()) refusal = result;
    if (!result.ok()) continue;
    if (nearest.goal && std::tie(nearest.plan.length, *nearest.goal) < std::tie(result.length, i))
      continue;
    nearest.goal = i;
    nearest.plan = std::move(result);
  }
  if (!nearest.goal) nearest.plan = std::move(*refusal);
  return nearest;
}

namespace {

/// What a status of a start says of the same place as a goal.
PlanStatus of_goal(PlanStatus status) {
  switch (status) {
    case PlanStatus::kStartOutsideMap:
      return PlanStatus::kGoalOutsideMap;
    case PlanStatus::kStartUnknown:
      return PlanStatus::kGoalUnknown;
    case PlanStatus::kStartInCollision:
      return PlanStatus::kGoalInCollision;
    case PlanStatus::kStartOutsideLimits:
      return PlanStatus::kGoalOutsideLimits;
    default:
      return status;
  }
}

/// Of a leg whose place on the way cannot be used as it is: the goal of a first leg, whose start
/// may be escaped from, else the start.
PlanResult why_not(const Roadmap& roadmap, const Point& from, const Point& to, bool is_first,
                   const PlanConfig& exact) {
  if (is_first) {
    PlanResult at_goal = plan(roadmap, to, to, exact);
    at_goal.status = of_goal(at_goal.status);
    if (!at_goal.ok()) return at_goal;
  }
  return plan(roadmap, from, to, exact);
}

/// One leg after another, each from where the one before ends.
void append_leg(const PlanResult& leg, PlanResult& whole) {
  if (whole.waypoints.empty()) {
    whole = leg;
    return;
  }
  for (const Point& place : std::span(leg.waypoints).subspan(1))
    if (place != whole.waypoints.back() || whole.waypoints.size() < 2)
      whole.waypoints.push_back(place);
  whole.length += leg.length;
  whole.clearance = std::min(whole.clearance, leg.clearance);
  whole.escape_goal = leg.escape_goal;
  whole.moved_goal = leg.moved_goal;
  whole.answered_by = std::max(whole.answered_by, leg.answered_by);
  for (double PlanSeconds::*part :
       {&PlanSeconds::attach, &PlanSeconds::search, &PlanSeconds::shorten, &PlanSeconds::total})
    whole.seconds.*part += leg.seconds.*part;
}

}  // namespace

ViaPlan plan_via(const Roadmap& roadmap, std::span<const Point> places, const PlanConfig& config) {
  config.validate();
  if (places.size() < 2) throw InputError("places", "are less than two", "give start and goal");
  PlanConfig exact = config;
  exact.escape = false;
  exact.snap = 0.0;
  ViaPlan via;
  double straight = 0.0;  // over the places: no path over them is shorter
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const bool is_first = i == 0, is_last = i + 2 == places.size();
    PlanResult leg = plan(roadmap, places[i], places[i + 1], is_first || is_last ? config : exact);
    const bool strays =
        (!is_first && (leg.escape_start.length > 0.0 || leg.moved_start.distance > 0.0)) ||
        (!is_last && (leg.escape_goal.length > 0.0 || leg.moved_goal.distance > 0.0));
    if (strays) leg = why_not(roadmap, places[i], places[i + 1], is_first, exact);
    if (!leg.ok()) return {std::move(leg), i};
    straight += (leg.waypoints.back() - leg.waypoints.front()).norm();
    append_leg(leg, via.plan);
  }
  via.plan.within = detail::within_bound(via.plan.length, straight);
  return via;
}

}  // namespace ridgeway
