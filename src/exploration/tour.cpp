// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tour.hpp"

#include <algorithm>
#include <limits>

namespace ridgeway::detail {
namespace {

constexpr double kLeastSaving = 1e-6;  // seconds: no moves for rounding
constexpr int kMostRounds = 50;

/// Cost of the step to a place of the tour from the one before.
double step_cost(const TourCosts& costs, const std::vector<std::size_t>& tour, std::size_t i) {
  return i == 0 ? costs.first[tour[0]] : costs.between[tour[i - 1]][tour[i]];
}

/// The tour with a stop where it costs least.
void insert_best(const TourCosts& costs, std::vector<std::size_t>& tour, std::size_t stop) {
  double best = std::numeric_limits<double>::infinity();
  std::size_t where = tour.size();
  for (std::size_t i = 0; i <= tour.size(); ++i) {
    const double to = i == 0 ? costs.first[stop] : costs.between[tour[i - 1]][stop];
    const double more =
        i == tour.size() ? to : to + costs.between[stop][tour[i]] - step_cost(costs, tour, i);
    if (more < best) {
      best = more;
      where = i;
    }
  }
  tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(where), stop);
}

/// Keeps a changed tour if it is shorter.
bool accept(const TourCosts& costs, std::vector<std::size_t>& tour, double& cost,
            std::vector<std::size_t> changed) {
  const double now = cost_of(costs, changed);
  if (now >= cost - kLeastSaving) return false;
  tour = std::move(changed);
  cost = now;
  return true;
}

bool turn_round(const TourCosts& costs, std::vector<std::size_t>& tour, double& cost) {
  const auto n = static_cast<std::ptrdiff_t>(tour.size());
  for (std::ptrdiff_t i = 0; i < n; ++i)
    for (std::ptrdiff_t j = i + 2; j <= n; ++j) {
      std::vector<std::size_t> changed = tour;
      std::reverse(changed.begin() + i, changed.begin() + j);
      if (accept(costs, tour, cost, std::move(changed))) return true;
    }
  return false;
}

bool move_piece(const TourCosts& costs, std::vector<std::size_t>& tour, double& cost) {
  constexpr std::ptrdiff_t kLongest = 3;
  const auto n = static_cast<std::ptrdiff_t>(tour.size());
  for (std::ptrdiff_t length = 1; length <= kLongest && length < n; ++length)
    for (std::ptrdiff_t i = 0; i + length <= n; ++i)
      for (std::ptrdiff_t to = 0; to + length <= n; ++to) {
        if (to == i) continue;
        std::vector<std::size_t> changed = tour;
        const std::vector<std::size_t> piece(tour.begin() + i, tour.begin() + i + length);
        changed.erase(changed.begin() + i, changed.begin() + i + length);
        changed.insert(changed.begin() + to, piece.begin(), piece.end());
        if (accept(costs, tour, cost, std::move(changed))) return true;
      }
  return false;
}

}  // namespace

double cost_of(const TourCosts& costs, const std::vector<std::size_t>& tour) {
  double cost = 0.0;
  for (std::size_t i = 0; i < tour.size(); ++i) cost += step_cost(costs, tour, i);
  return cost;
}

std::vector<std::size_t> shortest_tour(const TourCosts& costs) {
  const std::size_t n = costs.first.size();
  std::vector<std::size_t> by_cost(n);
  for (std::size_t i = 0; i < n; ++i) by_cost[i] = i;
  std::stable_sort(by_cost.begin(), by_cost.end(),
                   [&](std::size_t a, std::size_t b) { return costs.first[a] < costs.first[b]; });
  std::vector<std::size_t> tour;
  for (const std::size_t stop : by_cost) insert_best(costs, tour, stop);
  double cost = cost_of(costs, tour);
  for (int round = 0; round < kMostRounds; ++round)
    if (!turn_round(costs, tour, cost) && !move_piece(costs, tour, cost)) break;
  return tour;
}

}  // namespace ridgeway::detail
