// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/alternatives.hpp"

#include <algorithm>

#include "deformation.hpp"
#include "paths/deadline.hpp"
#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"
#include "query.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "route_enumeration.hpp"

namespace ridgeway {
namespace {

using detail::Deadline;

/// Smallest distance between two segments.
double distance_between(const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  const Point a = a1 - a0, b = b1 - b0, c = a0 - b0;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ac = a.dot(c), bc = b.dot(c), divisor = aa * bb - ab * ab;
  const auto share = [](double numerator, double denominator) {
    return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
  };
  double s = share(ab * bc - bb * ac, divisor);
  const double t = share(ab * s + bc, bb);
  s = share(ab * t - ac, aa);
  return (c + s * a - t * b).norm();
}

/// Whether a tight path comes back to where it was, to within the radius: the two sides of an
/// obstacle that it bends around are two radii apart.
bool meets_itself(const std::vector<Point>& path, double radius) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    double between = 0.0;  // along the path, from the end of segment i to the start of segment j
    for (std::size_t j = i + 1; j < path.size(); ++j) {
      if (between > detail::kPlanning.apart * radius &&
          distance_between(path[i - 1], path[i], path[j - 1], path[j]) < radius)
        return true;
      between += (path[j] - path[j - 1]).norm();
    }
  }
  return false;
}

/// Whether all places of a path are within a distance of another path.
bool stays_beside(const std::vector<Point>& path, const std::vector<Point>& other,
                  double distance) {
  constexpr double kStep = 0.25;  // of the distance, between the places looked at
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point along = path[i] - path[i - 1];
    const int pieces = 1 + static_cast<int>(along.norm() / (kStep * distance));
    for (int k = 0; k <= pieces; ++k) {
      const Point p = path[i - 1] + along * (static_cast<double>(k) / pieces);
      bool is_beside = false;
      for (std::size_t j = 1; j < other.size() && !is_beside; ++j)
        is_beside = distance_between(p, p, other[j - 1], other[j]) < distance;
      if (!is_beside) return false;
    }
  }
  return true;
}

/// Whether two paths are one but for wiggles: tight ones on two sides of an obstacle are two radii
/// apart there, and more.
bool run_together(const std::vector<Point>& a, const std::vector<Point>& b, double radius) {
  return stays_beside(a, b, radius) && stays_beside(b, a, radius);
}

/// The routes found, no two of one class, shortest first.
class DistinctRoutes {
 public:
  DistinctRoutes(const FreeSpace& space, double radius) : space_(space), radius_(radius) {}

  /// Whether a path is in the class of one of them.
  bool know(const std::vector<Point>& path) const {
    return std::any_of(routes_.begin(), routes_.end(), [&](const PlanResult& route) {
      return detail::deforms_into(space_, path, route.waypoints, radius_);
    });
  }

  /// Keeps a route unless it is in the class of a shorter one.
  void add(PlanResult route) {
    const auto is_alike = [&](const PlanResult& other) {
      return detail::deforms_into(space_, route.waypoints, other.waypoints, radius_) ||
             run_together(route.waypoints, other.waypoints, radius_);
    };
    const auto is_shorter = [](const PlanResult& a, const PlanResult& b) {
      return a.length < b.length;
    };
    const auto place = std::upper_bound(routes_.begin(), routes_.end(), route, is_shorter);
    if (std::any_of(routes_.begin(), place, is_alike)) return;
    routes_.erase(std::remove_if(place, routes_.end(), is_alike), routes_.end());
    routes_.insert(std::upper_bound(routes_.begin(), routes_.end(), route, is_shorter),
                   std::move(route));
  }

  /// Whether a route as long as this before it is shortened can still be among the first `count`.
  bool may_use(double length, std::size_t count) const {
    return routes_.size() < count ||
           length * detail::kPlanning.shrinks_to < routes_[count - 1].length;
  }

  std::vector<PlanResult> first(std::size_t count) && {
    if (routes_.size() > count) routes_.resize(count);
    return std::move(routes_);
  }

 private:
  const FreeSpace& space_;
  const double radius_;
  std::vector<PlanResult> routes_;
};

/// Pulled tight without leaving its class.
PlanResult tighten(const FreeSpace& space, detail::Route route, double radius,
                   const Deadline& deadline) {
  const auto stays_in_class = [&](std::span<const Point> before, std::span<const Point> after) {
    return detail::deforms_into(space, before, after, radius);
  };
  for (int i = 0; i < detail::kPlanning.shortenings; ++i)
    route = detail::shorten(space, std::move(route), radius, deadline, stays_in_class);
  PlanResult result;
  result.status = PlanStatus::kOk;
  result.waypoints = std::move(route);
  detail::describe(space, {}, result);
  return result;
}

/// plan_alternatives() between points of the local frame, with waypoints there.
Alternatives alternatives_locally(const Roadmap& roadmap, const Point& start, const Point& goal,
                                  std::size_t count, const PlanConfig& config) {
  if (config.planner != Planner::kGraph || !config.shorten || config.prefer_clearance != 0.0 ||
      config.escape || config.quick || config.within != 0.0)
    throw InputError("alternatives", "are planned on the graph and pulled tight",
                     "leave out the planner, raw paths (shorten), escapes, the preference for "
                     "clearance and a quality (quick, within)");
  if (count == 0) throw InputError("alternatives", "are none", "ask for at least 1");
  const double began = detail::seconds_now();
  const Deadline deadline(config.time_limit);
  Alternatives result;
  PlanResult shortest = detail::plan_locally(roadmap, start, goal, config);
  result.status = shortest.status;
  if (shortest.ok()) {
    const EsdfMap& esdf = roadmap.esdf;
    const FlightLimits limits = detail::limits_of(esdf, config.limits);
    const double radius = config.radius.value_or(roadmap.min_clearance);
    const FreeSpace space(esdf, limits, radius, config.robot_height);
    const Moved moved_start = shortest.moved_start, moved_goal = shortest.moved_goal;
    const Point from = shortest.waypoints.front(), to = shortest.waypoints.back();
    const detail::QueryEnds ends = detail::find_ends(space, from, to, radius);
    if (ends.status != PlanStatus::kOk) {  // straight on, where no voxel's centre is free
      result.complete = true;
      result.routes.push_back(std::move(shortest));
      result.seconds = detail::seconds_now() - began;
      return result;
    }
    DistinctRoutes routes(space, radius);
    routes.add(std::move(shortest));
    detail::RouteEnumeration others(roadmap, space, {ends.from, ends.to, from, to, radius},
                                    deadline);
    std::optional<detail::Route> route;
    while ((route = others.next()) && routes.may_use(length_of(*route), count)) {
      if (routes.know(*route)) continue;
      PlanResult tight = tighten(space, std::move(*route), radius, deadline);
      tight.unknown = esdf.unknown;
      tight.moved_start = moved_start;
      tight.moved_goal = moved_goal;
      if (others.time_is_up()) break;
      if (!meets_itself(tight.waypoints, radius) && detail::is_verified(esdf, space, tight, radius))
        routes.add(std::move(tight));
    }
    result.complete = !route && others.complete();
    result.routes = std::move(routes).first(count);
  }
  result.seconds = detail::seconds_now() - began;
  return result;
}

}  // namespace

Alternatives plan_alternatives(const Roadmap& roadmap, const Point& start, const Point& goal,
                               std::size_t count, const PlanConfig& config) {
  const EsdfMap& esdf = roadmap.esdf;
  const double radius = config.radius.value_or(roadmap.min_clearance);
  const Point from = detail::place_in_local(esdf, start, radius);
  const Point to = detail::place_in_local(esdf, goal, radius);
  Alternatives result = alternatives_locally(roadmap, from, to, count, config);
  for (PlanResult& route : result.routes) {
    detail::move_to_world(esdf, start, goal, route);
    route.planned_for = {radius, config.robot_height, config.limits};
  }
  return result;
}

}  // namespace ridgeway
