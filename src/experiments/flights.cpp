// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "flights.hpp"

#include <cmath>

#include "common/number_text.hpp"
#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

namespace ridgeway {
namespace {

constexpr double kNear = 30.0;            // metres: paths whose time to compute counts apart
constexpr std::size_t kDrawsAQuery = 50;  // pairs drawn for each that is asked for, at most

TrajectoryConfig trajectory_config(const FlightsConfig& config) {
  TrajectoryConfig result;
  result.radius = config.min_clearance;
  result.motion = config.motion;
  return result;
}

std::vector<VoxelId> places_to_fly(const EsdfMap& esdf, double radius) {
  std::vector<VoxelId> voxels;
  const auto least = least_clearance(radius, esdf.voxel_size);
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (esdf.is_open(id) && esdf.squared[id] >= least) voxels.push_back(id);
  return voxels;
}

/// Paths between the centres of two voxels drawn at random, where there is one.
std::vector<Flight> draw_queries(const Roadmap& roadmap, const FlightsConfig& config) {
  const std::vector<VoxelId> places = places_to_fly(roadmap.esdf, config.min_clearance);
  if (places.empty())
    throw InputError("the map", "has no place for a robot of " + number_text(config.min_clearance),
                     "give a smaller clearance");
  Random random(config.seed);
  const auto place = [&] {
    const VoxelId id = places[random.below(places.size())];
    const EsdfMap& esdf = roadmap.esdf;
    return to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
  };
  std::vector<Flight> flights;
  for (std::size_t draw = 0;
       draw < kDrawsAQuery * config.queries && flights.size() < config.queries; ++draw) {
    const Point start = place();
    PlanResult found = plan(roadmap, start, place());
    if (!found.ok()) continue;  // not connected
    Flight flight;
    flight.path = std::move(found.waypoints);
    flight.path_length = found.length;
    flights.push_back(std::move(flight));
  }
  return flights;
}

double trapezoid_duration(const std::vector<Point>& path, const MotionLimits& limits) {
  const double v = limits.max_speed, a = limits.max_acceleration;
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = (path[i] - path[i - 1]).norm();
    sum += length >= v * v / a ? length / v + v / a : 2.0 * std::sqrt(length / a);
  }
  return sum;
}

void fly(const EsdfMap& esdf, const FlightsConfig& config, Flight& flight) {
  flight.flown = plan_trajectory(esdf, flight.path, trajectory_config(config));
  flight.trapezoid_duration = trapezoid_duration(flight.path, config.motion);
}

void judge(const FlightJudge& judge, const FlightsConfig& config, Flight& flight) {
  const TrajectoryConfig rules = trajectory_config(config);
  const Point &start = flight.path.front(), &goal = flight.path.back();
  if (flight.flown.ok()) flight.verdict = judge.judge(flight.flown, start, goal, rules);
  TrajectoryResult spline;
  spline.trajectory = plain_spline(flight.path, rules);
  flight.plain_duration = spline.trajectory.duration();
  flight.plain_holds = judge.judge(spline, start, goal, rules).holds();
}

/// Over the flights that are ok, and for which there is a value.
template <typename Value>
Spread spread_over(const std::vector<Flight>& flights, const Value& value) {
  std::vector<double> values;
  for (const Flight& flight : flights) {
    const double x = flight.flown.ok() ? value(flight) : std::nan("");
    if (std::isfinite(x)) values.push_back(x);
  }
  return spread_of(std::move(values));
}

void count(FlightsResult& result) {
  constexpr double kRounding = 1.0 + 1e-9;
  for (const Flight& flight : result.flights) {
    result.plain_holds += flight.plain_holds;
    if (!flight.flown.ok()) continue;
    ++result.solved;
    ++result.steps[static_cast<std::size_t>(flight.flown.step)];
    result.violations += !flight.verdict.holds();
    const double duration = flight.flown.duration;
    result.longer_than_stop_and_go += duration > flight.flown.stop_and_go_duration * kRounding;
    const bool is_straight = flight.path.size() <= 2;
    result.straight += is_straight;
    result.longer_than_trapezoid +=
        !is_straight && duration > flight.trapezoid_duration * kRounding;
  }
}

void summarise(const MotionLimits& limits, FlightsResult& result) {
  const double v = limits.max_speed, a = limits.max_acceleration, none = std::nan("");
  const auto spread = [&](const auto& value) { return spread_over(result.flights, value); };
  const auto over = [&](const auto& other) {
    return spread([&](const Flight& f) { return f.flown.duration / other(f); });
  };
  result.seconds = spread([](const Flight& f) { return f.flown.seconds.total; });
  result.optimise_seconds = spread([](const Flight& f) { return f.flown.seconds.optimise; });
  result.verify_seconds = spread([](const Flight& f) { return f.flown.seconds.verify; });
  result.near_seconds = spread(
      [&](const Flight& f) { return f.path_length <= kNear ? f.flown.seconds.total : none; });
  result.duration = spread([](const Flight& f) { return f.flown.duration; });
  result.path_length = spread([](const Flight& f) { return f.path_length; });
  result.length_over_path =
      spread([](const Flight& f) { return f.verdict.length / f.path_length; });
  result.over_bound = over([&](const Flight& f) {
    return f.path_length >= v * v / a ? f.path_length / v + v / a : none;
  });
  result.over_stop_and_go = over([](const Flight& f) { return f.flown.stop_and_go_duration; });
  result.over_trapezoid = over([](const Flight& f) { return f.trapezoid_duration; });
  result.plain_over_flight =
      spread([](const Flight& f) { return f.plain_duration / f.flown.duration; });
}

}  // namespace

void FlightsConfig::validate() const {
  motion.validate();
  if (!(min_clearance > 0.0 && std::isfinite(min_clearance)))
    throw InputError("min_clearance", "is " + number_text(min_clearance), "give metres, above 0");
  if (queries < 1) throw InputError("queries", "is 0", "give 1 or more");
}

FlightsResult run_flights(const OccupancyMap& map, const FlightsConfig& config,
                          const Progress& progress) {
  config.validate();
  FlightsResult result;
  result.roadmap =
      build_roadmap(map, {.min_clearance = config.min_clearance, .unknown = config.unknown},
                    progress)
          .roadmap;
  result.flights = draw_queries(result.roadmap, config);
  std::size_t done = 0;
  for (Flight& flight : result.flights) {
    const auto share = static_cast<double>(done++) / static_cast<double>(result.flights.size());
    if (progress && !progress("fly", share)) throw Cancelled();
    fly(result.roadmap.esdf, config, flight);
  }
  if (progress && !progress("judge", 0.0)) throw Cancelled();
  const FlightJudge impartial(map, config.unknown);
  parallel_for_each_index(result.flights.size(),
                          [&](std::size_t i) { judge(impartial, config, result.flights[i]); });
  count(result);
  summarise(config.motion, result);
  return result;
}

}  // namespace ridgeway
