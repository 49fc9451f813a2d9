// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>

#include "common/clock.hpp"
#include "explorer_state.hpp"
#include "legs.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway {
namespace {

constexpr double kBetweenWaysHome = 1.0;  // seconds

}  // namespace

/// To a stop, and to rest there.
bool Explorer::State::fly_to(const Point& goal_local, double yaw, const FlightState& state,
                             ExplorationStep& step) const {
  const double began = detail::thread_seconds_now();
  auto flown = detail::fly_to_rest(*roadmap, config.motion,
                                   {to_world(roadmap->esdf, goal_local), yaw}, state);
  step.seconds.trajectory += detail::thread_seconds_now() - began;
  if (flown) step.trajectory = std::move(*flown);
  return flown.has_value();
}

/// Whether the robot is home in time if it flies a trajectory to its end (or stays, where it is
/// empty) and then, with the decision that comes next, from rest, home: by a trajectory in the map
/// as it is. No other flight is begun, so that there is always one.
bool Explorer::State::leaves_time_for_home(const FlightState& state, const Trajectory& trajectory,
                                           ExplorationStep& step) const {
  if (!std::isfinite(config.until)) return true;
  FlightState rest = {.time = state.time, .position = state.position, .yaw = state.yaw};
  if (!trajectory.segments.empty()) {
    const TrajectoryState end = trajectory.at(trajectory.duration());
    rest = {.time = state.time + end.time, .position = end.position, .yaw = end.yaw};
  }
  const double began = detail::thread_seconds_now(), left = config.until - rest.time - longest_gap;
  bool is_in_time =
      detail::most_seconds_to_rest(*roadmap, config.motion, rest.position, *config.home) <= left;
  if (!is_in_time) {
    const auto back = detail::fly_to_rest(*roadmap, config.motion, {*config.home, rest.yaw}, rest);
    is_in_time = back && back->duration() <= left;
  }
  step.seconds.trajectory += detail::thread_seconds_now() - began;
  return is_in_time;
}

/// What has to be kept from obstacles, metres.
double Explorer::State::kept_clearance() const {
  return config.kept_clearance > 0.0 ? config.kept_clearance : roadmap->min_clearance;
}

/// A trajectory is flown from now on. Where the robot does not fit at its beginning it leaves that
/// place first, and comes no nearer to anything until it is out.
void Explorer::State::take_off(Trajectory trajectory, double time) {
  constexpr double kStep = 0.02;  // seconds: a few centimetres, as it begins at rest
  flying = std::move(trajectory);
  flying_since = time;
  const FreeSpace space(roadmap->esdf);
  const auto room_at = [&](double seconds) {
    return space.distance(to_local(roadmap->esdf, flying.at(seconds).position));
  };
  room_at_first = room_at(0.0);
  out_after = 0.0;
  if (room_at_first >= kept_clearance()) return;
  while (out_after < flying.duration() && room_at(out_after) < kept_clearance()) out_after += kStep;
}

/// Whether the rest of what is flown is free no longer, for all that is known now.
bool Explorer::State::is_in_doubt(const FlightState& state) const {
  constexpr double kRounding = 1e-3;  // voxels
  const FreeSpace space(roadmap->esdf);
  const double flown = state.time - flying_since, left = out_after - flown;
  const Trajectory rest = to_local(roadmap->esdf, detail::tail_of(flying, flown));
  if (left <= 0.0) return !find_doubts(space, rest, kept_clearance()).empty();
  const double least = room_at_first - kRounding * roadmap->esdf.voxel_size;
  return least <= 0.0 || !find_doubts(space, detail::head_of(rest, left), least).empty() ||
         !find_doubts(space, detail::tail_of(rest, left), kept_clearance()).empty();
}

/// Where what is flown leads to in so many metres, from a time of the state's clock on.
Point Explorer::State::ahead(double seconds, double length) const {
  constexpr double kStep = 0.02;  // seconds
  double time = seconds - flying_since;
  Point place = flying.at(time).position;
  while (length > 0.0 && time < flying.duration()) {
    time += kStep;
    const Point next = flying.at(std::min(time, flying.duration())).position;
    length -= (next - place).norm();
    place = next;
  }
  return place;
}

/// To a stop: straight on, or along what was flown; in as little room as there is.
bool Explorer::State::brake(const FlightState& state, ExplorationStep& step) const {
  constexpr std::array kSlack = {1.5, 1.25, 1.1};  // jerk is bounded, too
  const double speed = state.velocity.norm();
  if (speed < 1e-9) return false;
  const FreeSpace space(roadmap->esdf);
  const Point here = to_local(roadmap->esdf, state.position);
  for (const double slack : kSlack) {
    const double length = slack * speed * speed / (2.0 * config.motion.max_acceleration);
    const Point straight_on = state.position + length * state.velocity / speed;
    for (const Point& end : {straight_on, ahead(state.time, length)}) {
      const Point there = to_local(roadmap->esdf, end);
      if (space.is_free(here, there, roadmap->min_clearance) &&
          fly_to(there, state.yaw, state, step))
        return true;
    }
  }
  return false;
}

void Explorer::State::go_home(const FlightState& state, bool arrived, ExplorationStep& step) {
  const bool is_there = !config.home || (arrived && (state.position - *config.home).norm() < 1e-3);
  if (is_there) {
    step.status = is_out_of_time  ? ExplorationStatus::kOutOfTime
                  : leads_nowhere ? ExplorationStatus::kStuck
                                  : ExplorationStatus::kComplete;
    return;
  }
  const bool can_wait = !arrived && !step.was_in_doubt;
  if (is_returning && can_wait) return;  // on the way
  // From a motion that is tried now and then: where it would be late, it is so at the next scan.
  const auto go_on_as_before = [&] {  // what is flown now, and from its end home, is in time
    step.trajectory = {};
    step.status = ExplorationStatus::kKeep;
  };
  if (can_wait && state.time < last_way_home + kBetweenWaysHome) return go_on_as_before();
  last_way_home = state.time;
  if (fly_to(to_local(roadmap->esdf, *config.home), state.yaw, state, step)) {
    const bool is_late = state.time + step.trajectory.duration() > config.until;
    if (is_late && can_wait) return go_on_as_before();
    is_returning = true;
    step.status = ExplorationStatus::kReturn;
  } else if (arrived) {
    step.status = ExplorationStatus::kStuck;
  }
}

}  // namespace ridgeway
