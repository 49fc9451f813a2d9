// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap_facts.hpp"

#include "console.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::cli {
namespace {

std::string metres(double value) { return text_of(value) + " m"; }

/// A radius that fits must fit as it is printed.
std::string metres_at_most(double value) { return metres(rounded_down(value)); }

std::string explain_collision(const Roadmap& roadmap, const Query& query, const Point& place) {
  const double distance = FreeSpace(roadmap.esdf).distance(place);
  std::string text = "it is " + metres(distance) + " from the nearest obstacle";
  if (distance >= query.radius)
    return text + ", but no voxel beside it can be reached at a radius of " + metres(query.radius) +
           ": move it a little";
  text += ", less than the radius of " + metres(query.radius) + ": move it";
  if (distance >= roadmap.min_clearance)
    return text + ", or give a --radius of at most " + metres_at_most(distance);
  return text + ", or build the map for a smaller robot with --min-clearance";
}

std::string explain_endpoint(const Roadmap& roadmap, const Query& query, PlanStatus status) {
  const bool is_start = status <= PlanStatus::kStartInCollision;
  const Point& place = is_start ? query.start : query.goal;
  const std::string text =
      std::string(is_start ? "the start " : "the goal ") + point_text(place) + " ";
  switch (status) {
    case PlanStatus::kStartOutsideMap:
    case PlanStatus::kGoalOutsideMap: {
      const auto bounds = known_bounds(occupancy_of(roadmap.esdf));
      if (!bounds) return text + "is outside the map, of which nothing is known";
      return text + "is outside the map: give one between " + point_text(bounds->min) + " and " +
             point_text(bounds->max);
    }
    case PlanStatus::kStartUnknown:
    case PlanStatus::kGoalUnknown:
      return text + "is in space that the map does not know: move it to where the map is free";
    default:
      return text + "cannot be used: " + explain_collision(roadmap, query, place);
  }
}

std::string explain_no_route(const Roadmap& roadmap, const Query& query, const std::string& file) {
  const std::string text =
      "start and goal are not connected at a radius of " + metres(query.radius);
  const auto radius = connecting_radius(roadmap, query);
  if (radius) return text + ", but they are at " + metres_at_most(*radius) + ": give that --radius";
  return text + ": see 'ridgeway info " + file +
         "' for the parts of the map and the radius at which they would join";
}

}  // namespace

OccupancyMap occupancy_of(const EsdfMap& esdf) {
  return {esdf.voxel_size, esdf.layout, esdf.state};
}

std::optional<double> connecting_radius(const Roadmap& roadmap, const Query& query) {
  constexpr int kSteps = 10;
  constexpr double kPatience = 0.5;  // seconds a query; too slow counts as not connected
  const auto is_connected = [&](double radius) {
    const PlanConfig config{.radius = radius, .shorten = false, .time_limit = kPatience};
    return plan(roadmap, query.start, query.goal, config).ok();
  };
  double low = roadmap.min_clearance, high = query.radius;
  if (high <= low || !is_connected(low)) return std::nullopt;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = 0.5 * (low + high);
    (is_connected(middle) ? low : high) = middle;
  }
  return low;
}

std::string explain(const Roadmap& roadmap, const Query& query, PlanStatus status,
                    const std::string& file) {
  switch (status) {
    case PlanStatus::kOk:
      return {};
    case PlanStatus::kNoRoute:
      return explain_no_route(roadmap, query, file);
    case PlanStatus::kRadiusTooSmall:
      return "the map was built for robots of a radius of " + metres(roadmap.min_clearance) +
             " and more, asked for " + metres(query.radius) +
             ": give a larger --radius, or build the map with a smaller --min-clearance";
    case PlanStatus::kTimeout:
      return "the limit came before a path was found: give a larger --time-limit";
    default:
      return explain_endpoint(roadmap, query, status);
  }
}

}  // namespace ridgeway::cli
