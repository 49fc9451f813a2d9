// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <vector>

namespace ridgeway::detail {

/// Seconds of going from one stop to another, and to each from where the robot is.
struct TourCosts {
  std::vector<double> first;                 ///< from the robot to each stop
  std::vector<std::vector<double>> between;  ///< [from][to]
  std::vector<double> gain;                  ///< of each stop; none: they are alike and count not
  /// What waits behind all stops, as a share of their gain: how much the end of the tour counts.
  double beyond = 0.1;
};

/// An order of all stops, from the robot on, not back, with a small cost: insertion, then 2-opt and
/// or-opt moves as long as one of them lowers it, so many at most. Deterministic; of equal ones the
/// first.
std::vector<std::size_t> best_tour(const TourCosts& costs, int most_moves = 50);

/// The time until a voxel is seen, of all that the stops gain and of what is beyond them: the mean
/// of the times of arrival by gain, with the end of the tour. Without gains the end alone.
double cost_of(const TourCosts& costs, const std::vector<std::size_t>& tour);

/// Until the last stop.
double seconds_of(const TourCosts& costs, const std::vector<std::size_t>& tour);

}  // namespace ridgeway::detail
