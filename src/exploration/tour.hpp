// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <vector>

namespace ridgeway::detail {

/// Costs of going from one stop to another, and to each from where the robot is.
struct TourCosts {
  std::vector<double> first;                 ///< from the robot to each stop
  std::vector<std::vector<double>> between;  ///< [from][to]
};

/// An order of all stops, from the robot on, not back: nearest insertion, then 2-opt and or-opt
/// moves as long as one of them makes the tour shorter. Deterministic; of equal ones the first.
std::vector<std::size_t> shortest_tour(const TourCosts& costs);

double cost_of(const TourCosts& costs, const std::vector<std::size_t>& tour);

}  // namespace ridgeway::detail
