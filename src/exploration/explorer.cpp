// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/exploration/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "explorer_state.hpp"
#include "planning/endpoint.hpp"
#include "ray_walk.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"
#include "shaped_trajectory.hpp"
#include "thread_clock.hpp"

namespace ridgeway {
namespace {

using detail::Access;
using detail::Place;
using detail::Stop;

constexpr double kTourPeriod = 1.0;  // seconds between tours while the goal is good
constexpr int kMostTries = 3;        // stops that are tried to be flown to in one decision
constexpr double kAsGood = 0.8;      // of a stop's gain: a nearer place that sees as much takes it

void require_state(const FlightState& state) {
  if (!state.position.allFinite() || !state.velocity.allFinite() ||
      !state.acceleration.allFinite() || !std::isfinite(state.yaw) || !std::isfinite(state.time))
    throw InputError("state", "is not finite", "give finite numbers");
}

}  // namespace

Explorer::State::State(const ExplorerConfig& given)
    : config(given),
      frontiers(given.within),
      diagram(given.spacing),
      views(given.view, given.headings) {}

Access Explorer::State::access_at(const Point& local) const {
  const FreeSpace space(roadmap->esdf);
  const detail::Endpoint end = detail::find_endpoint(space, local, roadmap->min_clearance);
  return end.voxel == kNoVoxel ? Access{} : detail::access_of(*roadmap, end.voxel);
}

/// Of a flight that begins and ends slowly, while the robot turns.
double Explorer::State::seconds_between(double length, double turn) const {
  const double v = config.limits.max_speed, a = config.limits.max_acceleration;
  const double flight = length < v * v / a ? 2.0 * std::sqrt(length / a) : length / v + v / a;
  return std::max(flight, std::abs(turn) / config.limits.max_yaw_rate);
}

double Explorer::State::seconds_from_robot(const TourStop& stop, const FlightState& state) const {
  const Place& place = places[stop.stop.place];
  const double turn = detail::turn_between(state.yaw, views.yaw_of(stop.stop.heading));
  double seconds = seconds_between(stop.from_robot, turn);
  const Eigen::Vector3d way = place.position - to_local(roadmap->esdf, state.position);
  if (way.norm() > 0.0)  // what is to be braked and made good
    seconds += (state.velocity.norm() - state.velocity.dot(way.normalized())) /
               config.limits.max_acceleration;
  if (goal && (place.position - goal->place.position).norm() < config.spacing)
    seconds -= config.persistence;
  return std::max(seconds, 0.0);
}

/// More than it takes: as if the robot stopped every three metres.
double Explorer::State::seconds_home(const Point& from_local, const Access& access) const {
  if (!config.home) return 0.0;
  const Point home = to_local(roadmap->esdf, *config.home);
  const double length = detail::WaysFrom(*roadmap, home, access_at(home)).to(from_local, access);
  const double v = config.limits.max_speed, a = config.limits.max_acceleration;
  return 1.1 * (length / v + v / a * (1.0 + length / 3.0));
}

void Explorer::State::look_around(const Point& here, bool thorough) {
  diagram.update(*roadmap);
  places = diagram.places();
  if (thorough) {
    constexpr std::uint64_t kOffDiagram = std::uint64_t{1} << 62;
    const std::vector<Place> more = detail::widest_places(*roadmap, config.spacing, kOffDiagram);
    places.insert(places.end(), more.begin(), more.end());
  }
  views.update(*roadmap, frontiers, config.least_frontier, places, here,
               thorough ? detail::Views::kAllRays : config.most_rays);
}

/// Unknown voxels that are in view from a place, within a share of the range, after what was seen
/// from there is in the map: looks in vain. After several of them a voxel is left alone.
void Explorer::State::count_looks(const Point& from, int heading, double share, int weight,
                                  const Place* standing) {
  const double s = roadmap->esdf.voxel_size;
  const double reach = share * config.view.range;
  std::vector<VoxelIndex> hopeless;
  for (const FrontierPart& part : frontiers.parts()) {
    if ((part.centroid - from).norm() > reach + kBlockSide * s) continue;
    bool is_seen = false;
    for (const VoxelIndex& target : part.targets) {
      const Point centre = centre_of(target, s);
      if ((centre - from).norm() > reach) continue;
      if ((views.headings_to(from, centre) >> heading & 1) == 0) continue;
      if (!detail::sees(roadmap->esdf, from, target)) continue;
      is_seen = true;
      int& count = looks[target];
      count += weight;
      if (count >= config.most_looks) hopeless.push_back(target);
    }
    if (is_seen && standing != nullptr) views.ban(*standing, part);
  }
  if (hopeless.empty()) return;
  frontiers.ignore(hopeless);
  frontiers.update(roadmap);
}

/// In flight a look counts where the robot is elsewhere, or turned, since the last one.
void Explorer::State::look_in_flight(const FlightState& state) {
  constexpr double kNear = 0.6;  // of the range: from farther off little may be measured
  const int heading = views.heading_of(state.yaw);
  const Point here = to_local(roadmap->esdf, state.position);
  if (last_look && heading == last_look->second &&
      (here - last_look->first).norm() < 0.5 * config.spacing)
    return;
  last_look.emplace(here, heading);
  // At the heading next to the true one the sides of the view differ by half a step at most.
  if (std::abs(detail::turn_between(state.yaw, views.yaw_of(heading))) <
      0.25 * 2.0 * std::numbers::pi / config.headings)
    count_looks(here, heading, kNear, 1, nullptr);
}

/// Stops that see all that can be seen, by what each adds; those out of reach are left out.
std::vector<Explorer::State::TourStop> Explorer::State::cover(const detail::WaysFrom& ways,
                                                              double least_gain) const {
  std::vector<std::uint64_t> covered(views.parts(), 0);
  const auto is_worse = [](const Stop& a, const Stop& b) {
    return a.gain != b.gain ? a.gain < b.gain : a.place > b.place;
  };
  std::priority_queue<Stop, std::vector<Stop>, decltype(is_worse)> queue(is_worse);
  std::vector<TourStop> reach(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (views.from_places()[i].empty()) continue;
    if (std::find(refused.begin(), refused.end(), places[i].id) != refused.end()) continue;
    const Access access = detail::access_of(*roadmap, roadmap->esdf.layout.find(places[i].voxel));
    const double length = ways.to(places[i].position, access);
    if (!std::isfinite(length)) continue;
    reach[i] = {{}, access, length};
    if (const Stop stop = views.best_heading(i, covered); stop.gain > 0.0) queue.push(stop);
  }
  std::vector<TourStop> stops;
  while (!queue.empty()) {
    const Stop top = queue.top();
    queue.pop();
    const Stop now = views.best_heading(top.place, covered);
    if (now.gain < least_gain || now.gain <= 0.0) continue;
    if (!queue.empty() && is_worse(now, queue.top())) {
      queue.push(now);
      continue;
    }
    views.cover(now.place, now.heading, covered);
    stops.push_back({now, reach[now.place].access, reach[now.place].from_robot});
    queue.push(now);
  }
  return stops;
}

std::vector<std::size_t> Explorer::State::order(const std::vector<TourStop>& stops,
                                                const FlightState& state, double& seconds) const {
  detail::TourCosts costs;
  for (const TourStop& stop : stops) costs.first.push_back(seconds_from_robot(stop, state));
  for (const TourStop& from : stops) {
    const Point& at = places[from.stop.place].position;
    const detail::WaysFrom ways(*roadmap, at, from.access);
    std::vector<double> row;
    for (const TourStop& to : stops)
      row.push_back(seconds_between(
          &from == &to ? 0.0 : std::min(1e6, ways.to(places[to.stop.place].position, to.access)),
          detail::turn_between(views.yaw_of(from.stop.heading), views.yaw_of(to.stop.heading))));
    costs.between.push_back(std::move(row));
  }
  const std::vector<std::size_t> tour = detail::shortest_tour(costs);
  seconds = detail::cost_of(costs, tour);
  return tour;
}

/// Another place may see about as much as the first stop and lie better on the way to the second.
void Explorer::State::refine_first(std::vector<TourStop>& stops,
                                   const std::vector<std::size_t>& tour, const FlightState& state,
                                   const detail::WaysFrom& ways) const {
  TourStop& first = stops[tour[0]];
  std::vector<std::uint64_t> others(views.parts(), 0);
  for (std::size_t i = 0; i < stops.size(); ++i)
    if (i != tour[0]) views.cover(stops[i].stop.place, stops[i].stop.heading, others);
  const double wanted = kAsGood * views.gain_at(first.stop.place, first.stop.heading, others);
  if (wanted <= 0.0) return;
  std::optional<detail::WaysFrom> onward;
  if (tour.size() > 1) {
    const TourStop& second = stops[tour[1]];
    onward.emplace(*roadmap, places[second.stop.place].position, second.access);
  }
  const auto cost_of = [&](const TourStop& stop) {
    double cost = seconds_from_robot(stop, state);
    if (onward)
      cost +=
          seconds_between(std::min(1e6, onward->to(places[stop.stop.place].position, stop.access)),
                          detail::turn_between(views.yaw_of(stop.stop.heading),
                                               views.yaw_of(stops[tour[1]].stop.heading)));
    return cost;
  };
  TourStop best = first;
  double best_cost = cost_of(first);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (views.from_places()[i].empty()) continue;
    if ((places[i].position - places[first.stop.place].position).norm() > config.view.range)
      continue;
    const Stop stop = views.best_heading(i, others);
    if (stop.gain < wanted) continue;
    if (std::find(refused.begin(), refused.end(), places[i].id) != refused.end()) continue;
    const Access access = detail::access_of(*roadmap, roadmap->esdf.layout.find(places[i].voxel));
    const TourStop other = {stop, access, ways.to(places[i].position, access)};
    if (!std::isfinite(other.from_robot)) continue;
    if (const double cost = cost_of(other); cost < best_cost - 1e-6) {
      best_cost = cost;
      best = other;
    }
  }
  first = best;
}

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

/// Finds the next goal and a trajectory there, or says that there is none to be seen from.
bool Explorer::State::choose(const FlightState& state, bool thorough, ExplorationStep& step) {
  double began = detail::thread_seconds_now();
  const Point here = to_local(roadmap->esdf, state.position);
  look_around(here, thorough);
  step.seconds.views += detail::thread_seconds_now() - began;
  began = detail::thread_seconds_now();
  const detail::WaysFrom ways(*roadmap, here, access_at(here));
  const double least_gain = thorough ? 0.0 : 0.5 * static_cast<double>(config.least_frontier);
  std::vector<TourStop> stops = cover(ways, least_gain);
  const bool can_see = !stops.empty();
  if (std::isfinite(config.until))
    std::erase_if(stops, [&](const TourStop& stop) {
      const double looking = seconds_from_robot(stop, state) + config.persistence + 2.0;
      return state.time + looking + seconds_home(places[stop.stop.place].position, stop.access) >
             config.until;
    });
  if (can_see && stops.empty()) {
    is_out_of_time = true;
    return true;
  }
  std::stable_sort(stops.begin(), stops.end(), [](const TourStop& a, const TourStop& b) {
    return a.from_robot < b.from_robot;
  });
  if (stops.size() > config.most_stops) stops.resize(config.most_stops);
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
  const bool at_rest = state.velocity.norm() < 1e-9;
  const std::size_t tries = at_rest ? tour.size() : std::min<std::size_t>(tour.size(), kMostTries);
  for (std::size_t i = 0; i < tries; ++i) {
    const Stop& stop = stops[tour[i]].stop;
    const Place& place = places[stop.place];
    if (i == 0 && goal && goal->place.id == place.id && goal->heading == stop.heading) {
      goal->promised = std::max(goal->promised, stop.gain);
      step.goal = step.tour[0];
      return true;  // as before
    }
    if (fly_to(place.position, views.yaw_of(stop.heading), state, step)) {
      goal = Goal{place, stop.heading, stop.gain};
      step.status = ExplorationStatus::kFly;
      step.goal = step.tour[i];
      refused.clear();
      return true;
    }
    refused.push_back(place.id);
  }
  return can_see && !at_rest;
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

void Explorer::State::go_on(const FlightState& state, bool arrived, ExplorationStep& step) {
  if (is_returning) {
    go_home(state, arrived || step.was_in_doubt, step);
    return;
  }
  if (goal) {
    const double looking = detail::thread_seconds_now();
    const double left =
        views.gain_now(*roadmap, frontiers, config.least_frontier, goal->place, goal->heading);
    step.seconds.views += detail::thread_seconds_now() - looking;
    const bool is_resolved = left < config.resolved_below * goal->promised;
    if (arrived) {  // `left` is of samples, which may miss what is in view

      count_looks(goal->place.position, goal->heading, 1.0, 2, &goal->place);
      views.note_changes(*roadmap, frontiers);
    }
    if (!arrived && !is_resolved && !step.was_in_doubt && state.time < last_tour + kTourPeriod)
      return;
    if (arrived || is_resolved || step.was_in_doubt) goal.reset();
  }
  const bool sees_something = choose(state, false, step);
  if (!sees_something && arrived) {
    if (!choose(state, true, step)) {
      goal.reset();
      go_home(state, arrived, step);
      return;
    }
  }
  if (is_out_of_time) go_home(state, arrived, step);
  if (step.status == ExplorationStatus::kKeep && arrived) step.status = ExplorationStatus::kStuck;
}

ExplorationStep Explorer::State::decide(std::shared_ptr<const Roadmap> now,
                                        const FlightState& given) {
  const bool arrived = given.time >= flying_since + flying.duration() - 1e-9;
  FlightState state = given;
  if (arrived) state.velocity = state.acceleration = Point::Zero();  // but for rounding
  const double began = detail::thread_seconds_now();
  ExplorationStep step;
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
  if (!step.trajectory.segments.empty()) {
    flying = step.trajectory;
    flying_since = state.time;
  }
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
  if (state.time < state_->flying_since)
    throw InputError("state.time", "is before that of the last trajectory",
                     "give seconds of one clock");
  return state_->decide(std::move(now), state);
}

const Frontiers& Explorer::frontiers() const { return state_->frontiers; }

}  // namespace ridgeway
