// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>

#include "explorer_state.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "shaped_trajectory.hpp"
#include "thread_clock.hpp"

namespace ridgeway {

bool Explorer::State::fly_to(const Point& goal_local, double yaw, const FlightState& state,
                             ExplorationStep& step) const {
  const double began = detail::thread_seconds_now();
  const double r = roadmap->min_clearance;
  const bool is_moving = state.velocity.norm() > 1e-9 || state.acceleration.norm() > 1e-9;
  const Point to = to_world(roadmap->esdf, goal_local);
  TrajectoryConfig fly = {.radius = r, .limits = config.limits, .follow_yaw = false};
  fly.start_velocity = state.velocity;
  fly.start_acceleration = state.acceleration;
  if (fly.start_velocity.norm() > config.limits.max_speed)  // by rounding
    fly.start_velocity *= config.limits.max_speed * (1.0 - 1e-12) / fly.start_velocity.norm();
  if (fly.start_acceleration.norm() > config.limits.max_acceleration)
    fly.start_acceleration *=
        config.limits.max_acceleration * (1.0 - 1e-12) / fly.start_acceleration.norm();
  TrajectoryResult flown;
  if ((to - state.position).norm() < 1e-9 && !is_moving) {
    const std::vector<Point> here = {state.position};
    flown = plan_trajectory(roadmap->esdf, here, fly);
  } else {
    const PlanResult path =
        plan(*roadmap, state.position, to, {.radius = r, .quick = true, .escape = !is_moving});
    if (!path.ok()) {
      step.seconds.trajectory += detail::thread_seconds_now() - began;
      return false;
    }
    flown = fly_plan(roadmap->esdf, path, fly);
  }
  step.seconds.trajectory += detail::thread_seconds_now() - began;
  if (!flown.ok()) return false;
  step.trajectory = std::move(flown.trajectory);
  detail::turn_to(step.trajectory, state.yaw, yaw, config.limits.max_yaw_rate);
  return true;
}

/// Whether the rest of what is flown is free no longer, for all that is known now.
bool Explorer::State::is_in_doubt(const FlightState& state) const {
  const double radius =
      config.kept_clearance > 0.0 ? config.kept_clearance : roadmap->min_clearance;
  const Trajectory rest = detail::moved(detail::tail_of(flying, state.time - flying_since),
                                        to_local(roadmap->esdf, Point::Zero()));
  return !find_doubts(roadmap->esdf, rest, radius).empty();
}

/// To a stop, straight on.
bool Explorer::State::brake(const FlightState& state, ExplorationStep& step) const {
  constexpr double kSlack = 1.5;  // jerk is bounded, too
  const double speed = state.velocity.norm();
  if (speed < 1e-9) return false;
  const double length = kSlack * speed * speed / (2.0 * config.limits.max_acceleration);
  const Point end = state.position + length * state.velocity / speed;
  return fly_to(to_local(roadmap->esdf, end), state.yaw, state, step);
}

void Explorer::State::go_home(const FlightState& state, bool arrived, ExplorationStep& step) {
  const bool is_there = !config.home || (arrived && (state.position - *config.home).norm() < 1e-3);
  if (is_there) {
    step.status = is_out_of_time ? ExplorationStatus::kOutOfTime : ExplorationStatus::kComplete;
    return;
  }
  if (is_returning && !arrived) return;  // on the way
  if (fly_to(to_local(roadmap->esdf, *config.home), state.yaw, state, step)) {
    is_returning = true;
    step.status = ExplorationStatus::kReturn;
  } else if (arrived) {
    step.status = ExplorationStatus::kStuck;
  }
}

}  // namespace ridgeway
