// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap_facts.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "common/number_text.hpp"
#include "common/rounding.hpp"
#include "console.hpp"
#include "esdf/widest_place.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway::cli {
namespace {

std::string metres(double value) { return text_of(value) + " m"; }

/// A radius that fits must fit as it is printed.
std::string metres_at_most(double value) { return metres(rounded_down(value)); }

/// What is in the way where there is no way at any radius.
std::string shut_text(const BlockedRoute& blocked) {
  if (blocked.place)
    return "unknown space lies between them, first at " + point_text(*blocked.place) +
           ": map what is there";
  if (blocked.map_end)
    return "an obstacle lies between them, right across the map; the only other way leads beyond "
           "where the map ends, at " +
           point_text(*blocked.map_end) + ": give a map that goes farther";
  return "obstacles enclose one of them";
}

nlohmann::ordered_json or_null(const std::optional<Point>& place) {
  return place ? json_of(*place) : nlohmann::ordered_json(nullptr);
}

}  // namespace

Query as_planned(Query query, const PlanResult& plan) {
  if (plan.moved_start.distance > 0.0) query.start = plan.moved_start.place;
  if (plan.moved_goal.distance > 0.0) query.goal = plan.moved_goal.place;
  return query;
}

PlanResult given_path(const Roadmap& roadmap, std::vector<Point> waypoints,
                      const std::string& where) {
  try {
    return given_plan(roadmap.esdf, std::move(waypoints));
  } catch (const InputError& error) {
    throw InputError(where, error.problem(), error.remedy());
  }
}

std::string AnswerFacts::or_snap(bool is_movable) const {
  if (!is_movable) return "";
  return asked_.snap > 0.0 ? ", or give a larger --snap" : ", or let --snap do so";
}

bool AnswerFacts::is_unknown_nearest(const Point& place, double radius) {
  if (roadmap_.esdf.unknown != UnknownPolicy::kObstacle) return false;
  const PathSurroundings found = surroundings(std::array{place, place}, radius);
  return found.unknown < found.known;
}

std::string AnswerFacts::explain_collision(const Query& query, const Point& place,
                                           bool is_movable) {
  const double distance = FreeSpace(roadmap_.esdf).distance(flight_place(roadmap_.esdf, place));
  const bool is_unknown = is_unknown_nearest(place, query.radius);
  if (distance <= 0.0) {
    std::string inside = std::string("it lies ") +
                         (is_unknown ? "beside what the map does not know" : "in an obstacle") +
                         ": move it to where the map is free";
    if (!is_movable) return inside;
    // Farther away it is hardly the place that was meant.
    const std::optional<double> snap = smallest_snap(
        roadmap_, query.start, query.goal, 16.0 * query.radius,
        {.radius = query.radius, .limits = asked_.limits, .robot_height = asked_.robot_height});
    return snap ? inside + ", or let --snap " + text_of(rounded_up(*snap)) + " do so" : inside;
  }
  std::string text = "it is " + metres(distance) + " from " +
                     (is_unknown ? "what the map does not know" : "the nearest obstacle");
  if (asked_.robot_height > 0.0)
    return text + ", and " + robot_text(query) + " does not fit there: move it" +
           or_snap(is_movable) + ", or give a smaller --radius or --robot-height";
  if (distance >= query.radius)
    return text + ", but no voxel beside it can be reached at a radius of " + metres(query.radius) +
           ": move it a little" + or_snap(is_movable);
  if (const auto widest = detail::widest_place(roadmap_.esdf);
      widest && widest->clearance < query.radius)
    return "no place of this map has room for a radius of " + metres(query.radius) +
           ": give a --radius of at most " + metres_at_most(widest->clearance) +
           ", which is what the widest place has, " + point_text(widest->place);
  text += ", less than the radius of " + metres(query.radius) + ": move it" + or_snap(is_movable);
  if (is_movable)
    text += asked_.escape ? " (there is no straight way to where the robot fits)"
                          : ", or give --escape to begin or end there";
  if (distance >= roadmap_.min_clearance)
    return text + ", or give a --radius of at most " + metres_at_most(distance);
  return text + ", or build the map for a smaller robot with --min-clearance";
}

std::string AnswerFacts::explain_endpoint(const Query& query, PlanStatus status,
                                          OnTheWay on_the_way) {
  const bool is_start =
      status <= PlanStatus::kStartInCollision || status == PlanStatus::kStartOutsideLimits;
  const bool is_movable = !(is_start ? on_the_way.start : on_the_way.goal);
  const Point& place = is_start ? query.start : query.goal;
  const char* name = !is_movable ? "the place on the way " : is_start ? "the start " : "the goal ";
  const std::string text = name + point_text(place) + " ";
  switch (status) {
    case PlanStatus::kStartOutsideMap:
    case PlanStatus::kGoalOutsideMap: {
      const auto bounds = known_bounds(occupancy_of(roadmap_.esdf));
      if (!bounds) return text + "is outside the map, of which nothing is known";
      return text + "is outside the map: give one between " + point_text(bounds->min) + " and " +
             point_text(bounds->max);
    }
    case PlanStatus::kStartUnknown:
    case PlanStatus::kGoalUnknown:
      return text + "is in space that the map does not know: move it to where the map is free" +
             or_snap(is_movable);
    case PlanStatus::kStartOutsideLimits:
    case PlanStatus::kGoalOutsideLimits:
      return text + "is outside the limits of the flight: move it, or give wider limits";
    default:
      return text + "cannot be used: " + explain_collision(query, place, is_movable);
  }
}

std::string AnswerFacts::robot_text(const Query& query) const {
  return "a robot with a radius of " + metres(query.radius) + " and a height of " +
         metres(asked_.robot_height);
}

std::string AnswerFacts::explain_no_route(const Query& query) {
  const bool is_upright = asked_.robot_height > 0.0;
  std::string text =
      "start and goal are not connected " +
      (is_upright ? "for " + robot_text(query) : "at a radius of " + metres(query.radius));
  const std::optional<BlockedRoute> blocked = this->blocked(query, PlanStatus::kNoRoute);
  const std::string or_lower = is_upright ? ", or a smaller --robot-height" : "";
  if (!blocked) return is_upright ? text + ": give a smaller --robot-height" : text;
  if (blocked->by == Blocker::kLimits)
    return text + " within the limits of the flight, but " +
           (is_upright ? "a ball of that radius is" : "they are") + " without: give wider limits" +
           or_lower;
  if (is_upright) text += ", nor for a ball of that radius";
  if (asked_.limits.any()) text += ", whatever the limits of the flight";
  // Not by their numbers: those that `info` gives are of the smallest radius.
  const EsdfMap& esdf = roadmap_.esdf;
  const auto volume = [&esdf](const Component& part) {
    const double size = esdf.planar ? part.volume / esdf.voxel_size : part.volume;
    return (size < 0.001 ? "less than 0.001" : text_of(size)) + (esdf.planar ? " m^2" : " m^3");
  };
  const std::string parts = " (the start is in a part of space of " +
                            volume(blocked->start_component) + ", the goal in one of " +
                            volume(blocked->goal_component) + ")";
  const char* what = blocked->by == Blocker::kUnknown ? "unknown space" : "an obstacle";
  if (blocked->radius == 0.0)
    return text + ", nor at any other" + parts + ": " + shut_text(*blocked);
  text += parts + ", but " + (is_upright ? "balls" : "they") + " are at " +
          metres_at_most(blocked->radius) + ", where " + what + " is in the way at " +
          point_text(*blocked->place) +
          (detail::is_as_wide(rounded_down(blocked->radius), roadmap_.min_clearance)
               ? ": give that --radius"
               : ": build the map with that --min-clearance");
  return asked_.limits.any() ? text + ", if the limits leave room for it" : text;
}

std::string AnswerFacts::reason(const Query& query, PlanStatus status, OnTheWay on_the_way) {
  switch (status) {
    case PlanStatus::kOk:
      return {};
    case PlanStatus::kNoRoute:
      return explain_no_route(query);
    case PlanStatus::kRadiusTooSmall:
      if (const double inner = 0.5 * asked_.robot_height; inner > 0.0 && inner < query.radius)
        return "the largest ball in a robot of that height has a radius of " + metres(inner) +
               ", and the map was built for " + metres(roadmap_.min_clearance) +
               " and more: build it with --min-clearance " + number_text(inner);
      return "the map was built for robots of a radius of " + metres(roadmap_.min_clearance) +
             " and more, asked for " + metres(query.radius) +
             ": give a larger --radius, or build the map with a smaller --min-clearance";
    case PlanStatus::kTimeout:
      return "the limit came before a path was found: give a larger --time-limit, or "
             "--iteration-limit where the planner samples";
    default:
      return explain_endpoint(query, status, on_the_way);
  }
}

std::optional<BlockedRoute> AnswerFacts::blocked(const Query& query, PlanStatus status) {
  if (status != PlanStatus::kNoRoute) return std::nullopt;
  if (!blocks_) blocks_.emplace(roadmap_);
  if (!last_ || last_->first != query)
    last_.emplace(query, blocks_->between(query.start, query.goal, query.radius, asked_.limits));
  const std::optional<BlockedRoute>& blocked = last_->second;
  // What is known is of balls. Where one gets through that is as wide as the robot, its height is
  // what does not fit.
  if (asked_.robot_height > 0.0 && blocked && blocked->by != Blocker::kLimits &&
      detail::is_as_wide(blocked->radius, query.radius))
    return std::nullopt;
  return blocked;
}

PathSurroundings AnswerFacts::surroundings(std::span<const Point> path, double radius) {
  if (!around_) around_.emplace(roadmap_.esdf);
  return around_->along(path, radius);
}

nlohmann::ordered_json json_of(const BlockedRoute& blocked) {
  return {{"blocked",
           {{"radius", blocked.radius},
            {"place", or_null(blocked.place)},
            {"by", std::string(name_of(blocked.by))},
            {"map_end", or_null(blocked.map_end)}}},
          {"components", {{"start", blocked.start_number}, {"goal", blocked.goal_number}}},
          {"component_volumes",
           {{"start", blocked.start_component.volume}, {"goal", blocked.goal_component.volume}}}};
}

}  // namespace ridgeway::cli
