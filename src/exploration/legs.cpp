// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "legs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "trajectory/shaped_trajectory.hpp"
#include "trajectory/straight_motion.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kAhead = 2.0;        // of v^2 / a: metres that are flown past the first stop
constexpr std::size_t kMostLegs = 3;  // of them
constexpr double kLate = 0.3;         // seconds by which a turn may end after a stop is passed
constexpr int kMostEvaluations = 30;  // of the cost of a trajectory: what it takes is bounded

bool is_moving(const FlightState& state) {
  return state.velocity.norm() > 1e-9 || state.acceleration.norm() > 1e-9;
}

/// From the robot's motion; what is a little above its limits counts as they do.
TrajectoryConfig flight_from(const Roadmap& roadmap, const MotionLimits& limits,
                             const FlightState& state) {
  TrajectoryConfig fly = {.radius = roadmap.min_clearance,
                          .motion = limits,
                          .follow_yaw = false,
                          .most_evaluations = kMostEvaluations};
  const auto within = [](const Point& vector, double most) -> Point {
    return vector.norm() > most ? Point(vector * (most * (1.0 - 1e-12) / vector.norm())) : vector;
  };
  if (!is_moving(state)) return fly;
  fly.start_velocity = within(state.velocity, limits.max_speed);
  fly.start_acceleration = within(state.acceleration, limits.max_acceleration);
  return fly;
}

/// The way from the robot past the first stop, and past others until enough is known of it.
std::vector<Point> way_past(const Roadmap& roadmap, const MotionLimits& limits,
                            std::span<const Viewpoint> stops, const FlightState& state,
                            std::size_t& count) {
  const double ahead = kAhead * limits.max_speed * limits.max_speed / limits.max_acceleration;
  const PlanConfig quick = {.radius = roadmap.min_clearance, .quick = true, .escape = false};
  std::vector<Point> way = {state.position};
  double beyond = 0.0;
  for (count = 0; count < std::min(stops.size(), kMostLegs) && beyond < ahead; ++count) {
    const PlanResult path = plan(roadmap, way.back(), stops[count].position, quick);
    if (!path.ok()) break;
    way.insert(way.end(), path.waypoints.begin() + 1, path.waypoints.end());
    if (count > 0) beyond += path.length;
  }
  return way;
}

/// When a trajectory is nearest to a place, and how near.
std::pair<double, double> nearest_approach(const Trajectory& trajectory, const Point& place) {
  constexpr double kStep = 0.05;  // seconds
  std::pair<double, double> best = {0.0, std::numeric_limits<double>::infinity()};
  for (const TrajectoryState& at : trajectory.sample(kStep))
    if (const double distance = (at.position - place).norm(); distance < best.second)
      best = {at.time, distance};
  return best;
}

}  // namespace

double seconds_of_leg(const MotionLimits& limits, double length, double turn) {
  constexpr double kFarthest = 1e6;
  const double v = limits.max_speed, a = limits.max_acceleration;
  const double way = std::min(length, kFarthest);
  const double flight = way < v * v / a ? 2.0 * std::sqrt(way / a) : way / v + v / a;
  return std::max(flight, std::abs(turn) / limits.max_yaw_rate);
}

double most_seconds_to_rest(const Roadmap& roadmap, const MotionLimits& limits, const Point& from,
                            const Point& to) {
  if ((to - from).norm() < 1e-9) return 0.0;
  const PlanResult path =
      plan(roadmap, from, to, {.radius = roadmap.min_clearance, .quick = true, .escape = true});
  if (!path.ok()) return std::numeric_limits<double>::infinity();
  double seconds = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i)
    for (const TrajectorySegment& piece :
         straight_motion(path.waypoints[i - 1], path.waypoints[i], limits))
      seconds += piece.duration;
  return seconds;
}

std::optional<Trajectory> fly_to_rest(const Roadmap& roadmap, const MotionLimits& limits,
                                      const Viewpoint& stop, const FlightState& state) {
  const TrajectoryConfig fly = flight_from(roadmap, limits, state);
  TrajectoryResult flown;
  if ((stop.position - state.position).norm() < 1e-9 && !is_moving(state)) {
    const std::vector<Point> here = {state.position};
    flown = plan_trajectory(roadmap.esdf, here, fly);
  } else {
    const PlanResult path =
        plan(roadmap, state.position, stop.position,
             {.radius = roadmap.min_clearance, .quick = true, .escape = !is_moving(state)});
    if (!path.ok()) return std::nullopt;
    flown = fly_plan(roadmap.esdf, path, fly);
  }
  if (!flown.ok()) return std::nullopt;
  turn_to(flown.trajectory, state.yaw, stop.yaw, limits.max_yaw_rate);
  return std::move(flown.trajectory);
}

std::optional<Passing> fly_past(const Roadmap& roadmap, const MotionLimits& limits,
                                std::span<const Viewpoint> stops, const FlightState& state,
                                double near) {
  std::size_t count = 0;
  const std::vector<Point> way = way_past(roadmap, limits, stops, state, count);
  if (count < 2) return std::nullopt;
  const TrajectoryResult flown =
      plan_trajectory(roadmap.esdf, way, flight_from(roadmap, limits, state));
  if (!flown.ok()) return std::nullopt;
  const auto [closest, distance] = nearest_approach(flown.trajectory, stops[0].position);
  const double turn = turn_between(state.yaw, stops[0].yaw);
  const double turning = std::abs(turn) / limits.max_yaw_rate;
  const double passing = std::max(closest, turning);
  if (distance > near || turning > closest + kLate || passing >= flown.duration)
    return std::nullopt;
  Passing result = {head_of(flown.trajectory, passing), passing};
  turn_to(result.trajectory, state.yaw, stops[0].yaw, limits.max_yaw_rate);
  Trajectory rest = tail_of(flown.trajectory, passing);
  turn_to(rest, state.yaw + turn, stops[count - 1].yaw, limits.max_yaw_rate);
  auto& segments = result.trajectory.segments;
  segments.insert(segments.end(), rest.segments.begin(), rest.segments.end());
  return result;
}

}  // namespace ridgeway::detail
