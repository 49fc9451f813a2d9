// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "expected_volume.hpp"
#include "explorer_state.hpp"
#include "legs.hpp"
#include "ridgeway/common/parallel.hpp"
#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway {
namespace {

using detail::Access;
using detail::Place;
using detail::Stop;

constexpr double kBraking = 1.5;   // times the shortest way to rest: jerk is bounded, too
constexpr double kLate = 0.3;      // seconds by which a turn may end after a stop is passed
constexpr double kCorners = 1.1;   // times a straight flight: what ways with corners take
constexpr double kLook = 1.0;      // seconds that a stop takes at least
constexpr std::size_t kAsked = 2;  // times the stops of a tour: so many are asked what is expected
constexpr double kAsGood = 0.8;    // of a stop's gain: a nearer place that sees as much takes it

}  // namespace

/// To a stop from the motion that the robot has now.
double Explorer::State::seconds_from_robot(const TourStop& stop, const FlightState& state) const {
  const Place& place = places[stop.stop.place];
  const double v = config.motion.max_speed, a = config.motion.max_acceleration;
  const double turn = detail::turn_between(state.yaw, views.yaw_of(stop.stop.heading));
  double seconds = detail::seconds_of_leg(config.motion, stop.from_robot, turn);
  const Eigen::Vector3d way = place.position - to_local(roadmap->esdf, state.position);
  const double speed = state.velocity.norm();
  if (speed > 0.0 && way.norm() > 0.0) {
    const double along = state.velocity.dot(way.normalized());
    seconds += (speed - along) / a;  // what is to be braked and made good
    // Where there is no time to turn until the stop is passed, the robot comes back to it.
    const double braking = kBraking * speed * speed / (2.0 * a);
    if (braking > stop.from_robot &&
        std::abs(turn) / config.motion.max_yaw_rate > stop.from_robot / v + kLate)
      seconds += speed / a + 2.0 * std::sqrt((braking - stop.from_robot) / a);
  }
  if (goal && (place.position - goal->place.position).norm() < config.spacing)
    seconds -= config.persistence;
  return std::max(seconds, 0.0);
}

/// Whether the robot is likely to be home in time from a stop: what is flown is held to that by the
/// trajectories there and back.
Explorer::State::MayStop Explorer::State::home_in_time(const FlightState& state) const {
  const Point home = to_local(roadmap->esdf, *config.home);
  const auto from_home = std::make_shared<const detail::WaysFrom>(*roadmap, home, access_at(home));
  return [this, from_home, state](const TourStop& stop) {
    const double length = from_home->to(places[stop.stop.place].position, stop.access);
    const double back = detail::seconds_of_leg(config.motion, length, 0.0);
    const double likely = kCorners * (seconds_from_robot(stop, state) + back);
    return state.time + likely + longest_gap <= config.until;
  };
}

/// Whether no trajectory led to a place, or none that left time for home, since the last flight.
bool Explorer::State::is_set_aside(const Place& place) const {
  const auto is_in = [&](const std::vector<std::uint64_t>& ids) {
    return std::find(ids.begin(), ids.end(), place.id) != ids.end();
  };
  return is_in(refused) || is_in(late);
}

/// Stops that see all that can be seen, by what each adds; those out of reach are left out, and
/// unless `with_refused` those that are set aside, and those that
/// may not be stopped at.
std::vector<Explorer::State::TourStop> Explorer::State::cover(const detail::WaysFrom& ways,
                                                              double least_gain, bool with_refused,
                                                              const MayStop& may_stop) const {
  std::vector<std::uint64_t> covered(views.parts(), 0);
  const auto is_worse = [](const Stop& a, const Stop& b) {
    return a.gain != b.gain ? a.gain < b.gain : a.place > b.place;
  };
  std::priority_queue<Stop, std::vector<Stop>, decltype(is_worse)> queue(is_worse);
  std::vector<TourStop> reach(places.size());
  parallel_for_each_index(places.size(), [&](std::size_t i) {
    if (views.from_places()[i].empty()) return;
    if (!with_refused && is_set_aside(places[i])) return;
    const Access access = detail::access_of(*roadmap, roadmap->esdf.layout.find(places[i].voxel));
    const double length = ways.to(places[i].position, access);
    if (std::isfinite(length)) reach[i] = {views.best_heading(i, covered), access, length};
  });
  for (const TourStop& stop : reach)
    if (stop.stop.gain > 0.0) queue.push(stop.stop);
  std::vector<TourStop> stops;
  while (!queue.empty()) {
    const Stop top = queue.top();
    queue.pop();
    const Stop now = views.best_heading(top.place, covered);
    if (now.gain < least_gain || now.gain <= 0.0) continue;
    const TourStop stop{now, reach[now.place].access, reach[now.place].from_robot};
    if (may_stop && !may_stop(stop)) continue;
    if (!queue.empty() && is_worse(now, queue.top())) {
      queue.push(now);
      continue;
    }
    views.cover(now.place, now.heading, covered);
    stops.push_back(stop);
    queue.push(now);
  }
  return stops;
}

/// Of the volume that a look is expected to measure the share that its frontiers have in what is in
/// view there: the others are seen from stops chosen before.
double Explorer::State::expected_at(const Stop& stop) const {
  const std::vector<std::uint64_t> none(views.parts(), 0);
  const double in_view = views.gain_at(stop.place, stop.heading, none);
  return stop.gain / in_view *
         detail::expected_voxels(roadmap->esdf, config.view, config.within,
                                 places[stop.place].position, views.yaw_of(stop.heading));
}

/// Leaves the stops that a tour is made of, the nearest first: those that give most for the time
/// that it takes to get there. Of those that give most by their frontiers it is asked what volume
/// is expected there.
void Explorer::State::keep_best(std::vector<TourStop>& stops, const FlightState& state) const {
  const auto keep = [&](std::size_t most, const auto& worth_of) {
    if (stops.size() <= most) return;
    const auto rate = [&](const TourStop& stop) {
      return worth_of(stop) / (kLook + seconds_from_robot(stop, state));
    };
    std::stable_sort(stops.begin(), stops.end(),
                     [&](const TourStop& a, const TourStop& b) { return rate(a) > rate(b); });
    stops.resize(most);
  };
  if (config.strategy == ExplorationStrategy::kTour) {
    keep(kAsked * config.most_stops, [](const TourStop& stop) { return stop.stop.gain; });
    parallel_for_each_index(stops.size(),
                            [&](std::size_t i) { stops[i].expected = expected_at(stops[i].stop); });
    keep(config.most_stops, [](const TourStop& stop) { return stop.expected; });
  }
  std::stable_sort(stops.begin(), stops.end(), [](const TourStop& a, const TourStop& b) {
    return a.from_robot < b.from_robot;
  });
  if (stops.size() > config.most_stops) stops.resize(config.most_stops);
}

std::vector<std::size_t> Explorer::State::order(const std::vector<TourStop>& stops,
                                                const FlightState& state, double& seconds) const {
  detail::TourCosts costs;
  for (const TourStop& stop : stops) costs.first.push_back(seconds_from_robot(stop, state));
  costs.between.resize(stops.size());
  parallel_for_each_index(stops.size(), [&](std::size_t i) {
    const TourStop& from = stops[i];
    const Point& at = places[from.stop.place].position;
    const detail::WaysFrom ways(*roadmap, at, from.access);
    costs.between[i].reserve(stops.size());
    for (const TourStop& to : stops)
      costs.between[i].push_back(detail::seconds_of_leg(
          config.motion, &from == &to ? 0.0 : ways.to(places[to.stop.place].position, to.access),
          detail::turn_between(views.yaw_of(from.stop.heading), views.yaw_of(to.stop.heading))));
  });
  for (const TourStop& stop : stops) costs.gain.push_back(stop.expected);
  std::vector<std::size_t> tour = detail::best_tour(costs);
  seconds = detail::seconds_of(costs, tour);
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
      cost += detail::seconds_of_leg(
          config.motion, onward->to(places[stop.stop.place].position, stop.access),
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
    if (is_set_aside(places[i])) continue;
    const Access access = detail::access_of(*roadmap, roadmap->esdf.layout.find(places[i].voxel));
    const TourStop other = {stop, access, ways.to(places[i].position, access), first.expected};
    if (!std::isfinite(other.from_robot)) continue;
    if (const double cost = cost_of(other); cost < best_cost - 1e-6) {
      best_cost = cost;
      best = other;
    }
  }
  first = best;
}

}  // namespace ridgeway
