// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/exploration/explorer.hpp"

#include <algorithm>
#include <cmath>

#include "common/clock.hpp"
#include "common/number_text.hpp"
#include "explorer_state.hpp"
#include "legs.hpp"
#include "planning/endpoint.hpp"
#include "planning/escape.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using detail::Access;
using detail::Place;
using detail::Stop;

constexpr double kDeepest = 6.0;     // metres of unknown space behind a frontier that count
constexpr double kTourPeriod = 1.0;  // seconds between tours while the goal is good
constexpr double kNear = 1.25;       // times the spacing: so far off a stop may be passed
constexpr double kFarOff = 1.5;      // seconds to a goal until which what follows it can wait
constexpr int kMostFlights = 3;      // trajectories that are tried in one decision

void require_state(const FlightState& state) {
  if (!state.position.allFinite() || !state.velocity.allFinite() ||
      !state.acceleration.allFinite() || !std::isfinite(state.yaw) || !std::isfinite(state.time))
    throw InputError("state", "is not finite", "give finite numbers");
}

/// As planned, but for how well it was followed and measured.
void require_within(const FlightState& state, const MotionLimits& limits) {
  constexpr double kMost = 1.1;  // times the limit
  const auto require_below = [](const char* name, const Point& value, double most) {
    if (value.norm() > kMost * most)
      throw InputError(
          name, "is " + number_text(value.norm()) + ", above the limit of " + number_text(most),
          "give a higher limit, or brake by the robot's own means first");
  };
  require_below("velocity", state.velocity, limits.max_speed);
  require_below("acceleration", state.acceleration, limits.max_acceleration);
}

}  // namespace

Explorer::State::State(const ExplorerConfig& given)
    : config(given),
      frontiers(given.within),
      diagram(given.spacing),
      views(given.view, given.headings, given.within,
            given.strategy == ExplorationStrategy::kTour ? kDeepest : 0.0),
      longest_gap(given.period) {}

Access Explorer::State::access_at(const Point& local) const {
  const FreeSpace space(roadmap->esdf);
  detail::Endpoint end = detail::find_endpoint(space, local, roadmap->min_clearance);
  // Where the robot does not fit any more trajectories from rest escape first.
  if (end.voxel == kNoVoxel) {
    const detail::EscapeResult out =
        detail::find_escape(space, local, roadmap->min_clearance, detail::Deadline::never());
    if (out.status == detail::SearchStatus::kFound)
      end = detail::find_endpoint(space, out.place, roadmap->min_clearance);
  }
  return end.voxel == kNoVoxel ? Access{} : detail::access_of(*roadmap, end.voxel);
}

/// Finds the next goal and a trajectory there, or says that there is none to be seen from.
bool Explorer::State::choose(const FlightState& state, bool thorough, ExplorationStep& step) {
  double began = detail::thread_seconds_now();
  leads_nowhere = is_out_of_time = false;
  const Point here = to_local(roadmap->esdf, state.position);
  const bool all_looked_at = look_around(here, thorough);
  step.seconds.views += detail::thread_seconds_now() - began;
  began = detail::thread_seconds_now();
  const Access access = access_at(here);
  const detail::WaysFrom ways(*roadmap, here, access);
  const double least_gain = thorough ? 0.0 : 0.5 * static_cast<double>(config.least_frontier);
  const bool is_timed = std::isfinite(config.until);
  std::vector<TourStop> stops =
      cover(ways, least_gain, false, is_timed ? home_in_time(state) : MayStop());
  const bool can_see = !stops.empty() || (is_timed && !cover(ways, least_gain, false).empty());
  if (stops.empty() && (can_see || !late.empty())) {
    is_out_of_time = thorough;  // else nearer places that see less are still to be looked at
    step.seconds.tour += detail::thread_seconds_now() - began;
    return thorough;
  }
  if (thorough && !can_see && !all_looked_at) {
    is_searching = true;
    return true;
  }
  // A robot without a way to anywhere sees nothing, which does not show that all is seen.
  if (thorough && !can_see)
    leads_nowhere =
        step.frontiers > 0 && (access.vertex == kNoVertex || !cover(ways, 0.0, true).empty());
  keep_best(stops, state);
  std::vector<std::size_t> tour(stops.size());
  for (std::size_t i = 0; i < tour.size(); ++i) tour[i] = i;
  if (config.strategy == ExplorationStrategy::kTour && !stops.empty()) {
    tour = order(stops, state, step.tour_seconds);
    refine_first(stops, tour, state, ways);
  }
  step.seconds.tour += detail::thread_seconds_now() - began;
  last_tour = state.time;
  for (const std::size_t i : tour) {
    const Stop& stop = stops[i].stop;
    step.tour.push_back(
        {to_world(roadmap->esdf, places[stop.place].position), views.yaw_of(stop.heading)});
  }
  const bool flies = fly_tour(stops, tour, state, step);
  const bool goes_on = is_searching || state.velocity.norm() >= 1e-9;
  if (thorough && !flies && !goes_on && !late.empty()) {
    is_out_of_time = true;
    return true;
  }
  leads_nowhere |= thorough && can_see && !flies && !goes_on;
  return flies || (can_see && goes_on);
}

/// To the first stop that a trajectory leads to from which the robot is home in time, on to the
/// next where the first can be passed. Only so many are tried; at rest the search goes on with the
/// next scan, in motion what is flown goes on.
bool Explorer::State::fly_tour(const std::vector<TourStop>& stops,
                               const std::vector<std::size_t>& tour, const FlightState& state,
                               ExplorationStep& step) {
  int flights = kMostFlights;
  for (std::size_t i = 0; i < tour.size(); ++i) {
    const Stop& stop = stops[tour[i]].stop;
    const Place& place = places[stop.place];
    const std::uint64_t next = i + 1 < tour.size() ? places[stops[tour[i + 1]].stop.place].id : 0;
    const bool is_kept =
        i == 0 && goal && goal->place.id == place.id && goal->heading == stop.heading;
    step.goal = step.tour[i];
    if (is_kept) {
      goal->promised = std::max(goal->promised, stop.gain);
      if (config.strategy == ExplorationStrategy::kNearest || goal->next == next ||
          goal->passed_at > state.time + kFarOff)
        return true;
    }
    const bool may_pass =
        config.strategy == ExplorationStrategy::kTour && !passed.contains({place.id, stop.heading});
    const double began = detail::thread_seconds_now();
    auto passing = may_pass && flights-- > 0
                       ? detail::fly_past(*roadmap, config.motion, std::span(step.tour).subspan(i),
                                          state, kNear * config.spacing)
                       : std::nullopt;
    step.seconds.trajectory += detail::thread_seconds_now() - began;
    if (passing && leaves_time_for_home(state, passing->trajectory, step)) {
      step.trajectory = std::move(passing->trajectory);
      look_on_the_way(step.trajectory, passing->time);
      goal = Goal{place, stop.heading, stop.gain, state.time + passing->time, next};
    } else {
      if (is_kept) return true;
      if (flights-- <= 0) {
        is_searching = state.velocity.norm() < 1e-9;
        break;
      }
      if (!fly_to(place.position, views.yaw_of(stop.heading), state, step)) {
        refused.push_back(place.id);
        continue;
      }
      if (!leaves_time_for_home(state, step.trajectory, step)) {
        step.trajectory = {};
        late.push_back(place.id);
        continue;
      }
      if (config.strategy == ExplorationStrategy::kTour)
        look_on_the_way(step.trajectory, step.trajectory.duration());
      goal = Goal{place, stop.heading, stop.gain};
    }
    step.status = ExplorationStatus::kFly;
    refused.clear();
    late.clear();
    return true;
  }
  step.goal.reset();
  return false;
}

void Explorer::State::go_on(const FlightState& state, bool arrived, ExplorationStep& step) {
  if (is_returning) {
    go_home(state, arrived, step);
    return;
  }
  if (goal) {
    const double looking = detail::thread_seconds_now();
    const double left =
        views.gain_now(*roadmap, frontiers, config.least_frontier, goal->place, goal->heading);
    step.seconds.views += detail::thread_seconds_now() - looking;
    const bool is_passed = state.time >= goal->passed_at - 1e-9;
    if (is_passed) passed.insert({goal->place.id, goal->heading});
    const bool is_resolved = is_passed || left < config.resolved_below * goal->promised;
    if (arrived && goal->next == 0) {  // `left` is of samples, which may miss what is in view
      count_looks(goal->place.position, goal->heading, 1.0, 2, &goal->place);
      views.note_changes(*roadmap, frontiers);
    }
    if (!arrived && !is_resolved && !step.was_in_doubt && state.time < last_tour + kTourPeriod)
      return;
    if (arrived || is_resolved || step.was_in_doubt) goal.reset();
  }
  if (arrived && !is_searching) late.clear();  // from here some may be in time
  is_searching = false;
  const bool sees_something = thorough_looks == 0 && choose(state, false, step);
  if (!sees_something && arrived) {
    const bool sees_after_all = choose(state, true, step);
    if (!is_searching) thorough_looks = 0;
    if (!sees_after_all) {
      has_seen_all = !is_out_of_time && !leads_nowhere;
      goal.reset();
      go_home(state, arrived, step);
      return;
    }
  }
  if (is_searching && !leaves_time_for_home(state, {}, step)) is_out_of_time = true;
  if (is_out_of_time) {
    is_searching = false;
    go_home(state, arrived, step);
  }
  if (step.status == ExplorationStatus::kKeep && arrived && !is_searching)
    step.status = ExplorationStatus::kStuck;
}

/// The map counts from another voxel, as it was built again: what is kept in its frame moves.
void Explorer::State::follow_origin(const VoxelIndex& by) {
  std::map<VoxelIndex, int> moved;
  for (const auto& [voxel, count] : looks) moved.emplace(voxel + by, count);
  looks = std::move(moved);
  refused.clear();  // by number, and places are others now
  late.clear();
  passed.clear();
  last_look.reset();
  goal.reset();
}

ExplorationStep Explorer::State::decide(std::shared_ptr<const Roadmap> now,
                                        const FlightState& given) {
  const bool arrived = given.time >= flying_since + flying.duration() - 1e-9;
  FlightState state = given;
  if (arrived && !flying.segments.empty())
    state.velocity = state.acceleration = Point::Zero();  // but for rounding
  const double began = detail::thread_seconds_now();
  ExplorationStep step;
  if (std::isfinite(asked_last)) longest_gap = std::max(longest_gap, given.time - asked_last);
  asked_last = given.time;
  if (roadmap && roadmap->esdf.origin != now->esdf.origin)
    follow_origin(roadmap->esdf.origin - now->esdf.origin);
  roadmap = std::move(now);
  frontiers.update(roadmap);
  views.note_changes(*roadmap, frontiers);
  look_in_flight(given);
  views.note_changes(*roadmap, frontiers);
  for (const FrontierCluster& cluster : frontiers.clusters())
    if (cluster.voxels >= config.least_frontier) {
      ++step.frontiers;
      step.frontier_voxels += cluster.voxels;
    }
  step.seconds.frontiers = detail::thread_seconds_now() - began;
  step.was_in_doubt = !arrived && is_in_doubt(state);
  go_on(state, arrived, step);
  if (step.was_in_doubt && step.trajectory.segments.empty() && brake(state, step)) {
    step.status = ExplorationStatus::kFly;
    step.is_braking = true;
  }
  if (!step.trajectory.segments.empty()) take_off(step.trajectory, state.time);
  step.seconds.total = detail::thread_seconds_now() - began;
  return step;
}

Explorer::Explorer(const ExplorerConfig& config) {
  config.validate();
  state_ = std::make_unique<State>(config);
}
Explorer::~Explorer() = default;
Explorer::Explorer(Explorer&&) noexcept = default;
Explorer& Explorer::operator=(Explorer&&) noexcept = default;

ExplorationStep Explorer::decide(std::shared_ptr<const Roadmap> now, const FlightState& state) {
  if (!now) throw InputError("roadmap", "is none", "give one as soon as a voxel is traversable");
  if (now->esdf.unknown != UnknownPolicy::kObstacle)
    throw InputError("roadmap", "does not take unknown space for an obstacle",
                     "build it with that policy");
  require_state(state);
  require_within(state, state_->config.motion);
  if (state_->config.kept_clearance > now->min_clearance)
    throw InputError("kept_clearance",
                     "is more than the roadmap's min_clearance, which trajectories keep",
                     "give at most " + number_text(now->min_clearance));
  if (state.time < state_->asked_last)
    throw InputError("time", "is before that of the last decision", "give seconds of one clock");
  return state_->decide(std::move(now), state);
}

const Frontiers& Explorer::frontiers() const { return state_->frontiers; }

}  // namespace ridgeway
