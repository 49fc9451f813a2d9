// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flight_judge.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// How long do flights along planned paths take, and do they hold? Lengths in metres.
struct FlightsConfig {
  double min_clearance = 0.3;  ///< of the roadmap, and radius of the robot
  UnknownPolicy unknown = UnknownPolicy::kObstacle;
  MotionLimits motion = {};
  std::size_t queries = 200;  ///< pairs of traversable voxels that a path connects
  std::uint64_t seed = 1;     ///< of starts and goals

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// One query.
struct Flight {
  std::vector<Point> path;  ///< of the roadmap, start first
  double path_length = 0.0;
  TrajectoryResult flown;
  FlightVerdict verdict;  ///< an independent judge's; of flights that are ok
  /// Seconds of ideal stop and go on the same path: a trapezoidal speed profile each leg, with
  /// jumps of acceleration, which no motion with limited jerk attains.
  double trapezoid_duration = 0.0;
  double plain_duration = 0.0;  ///< of the spline that is not optimised in the distance field
  bool plain_holds = false;     ///< says the judge
};

/// All flights on one map and what they have in common. Spreads are over the flights that are ok;
/// ratios of durations but for those of a path without length.
struct FlightsResult {
  Roadmap roadmap;
  std::vector<Flight> flights;  ///< one a query; fewer than asked for only where pairs that a path
                                ///< connects are hard to find
  std::size_t solved = 0;       ///< there is a flight
  std::size_t violations = 0;   ///< of these the judge complains
  std::array<std::size_t, 5> steps{};  ///< how many needed each TrajectoryStep
  std::size_t straight = 0;  ///< paths of a single leg, on which the trapezoid is out of reach
  std::size_t longer_than_stop_and_go = 0;
  std::size_t longer_than_trapezoid = 0;  ///< of the paths with corners
  std::size_t plain_holds = 0;
  Spread seconds, optimise_seconds, verify_seconds;  ///< to compute, given the path
  Spread near_seconds;                               ///< the same, of paths up to 30 m
  Spread duration, path_length;
  Spread length_over_path;  ///< of the curve, over the path
  Spread over_bound;        ///< duration over L / v + v / a, of paths of L >= v^2 / a
  Spread over_stop_and_go, over_trapezoid;
  Spread plain_over_flight;  ///< duration of the plain spline, over that of the flight

  std::size_t fallbacks() const { return solved - steps[0]; }
};

/// Builds a roadmap of a map and flies the shortened paths between random places of its traversable
/// voxels, one after the other on one thread, from rest to rest. Throws InputError for a map
/// without such a place, or a bad configuration.
FlightsResult run_flights(const OccupancyMap& map, const FlightsConfig& config,
                          const Progress& progress = {});

}  // namespace ridgeway
