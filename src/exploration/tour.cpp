// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "tour.hpp"

#include <algorithm>

namespace ridgeway::detail {
namespace {

constexpr double kLeastSaving = 1e-6;  // seconds: no moves for rounding

/// Keeps a changed tour if it costs less.
bool accept(const TourCosts& costs, std::vector<std::size_t>& tour, double& cost,
            std::vector<std::size_t>& changed) {
  const double now = cost_of(costs, changed);
  if (now >= cost - kLeastSaving) return false;
  tour.swap(changed);
  cost = now;
  return true;
}

/// The tour with a stop where it costs least.
void insert_best(const TourCosts& costs, std::vector<std::size_t>& tour, std::size_t stop) {
  tour.push_back(stop);
  std::vector<std::size_t> changed = tour;
  std::size_t where = tour.size() - 1;
  double best = cost_of(costs, tour);
  for (std::size_t i = where; i > 0; --i) {
    std::swap(changed[i - 1], changed[i]);
    const double cost = cost_of(costs, changed);
    if (cost < best) {
      best = cost;
      where = i - 1;
    }
  }
  std::rotate(tour.begin() + static_cast<std::ptrdiff_t>(where), tour.end() - 1, tour.end());
}

bool turn_round(const TourCosts& costs, std::vector<std::size_t>& tour, double& cost) {
  const auto n = static_cast<std::ptrdiff_t>(tour.size());
  std::vector<std::size_t> changed;
  for (std::ptrdiff_t i = 0; i < n; ++i)
    for (std::ptrdiff_t j = i + 2; j <= n; ++j) {
      changed = tour;
      std::reverse(changed.begin() + i, changed.begin() + j);
      if (accept(costs, tour, cost, changed)) return true;
    }
  return false;
}

bool move_piece(const TourCosts& costs, std::vector<std::size_t>& tour, double& cost) {
  constexpr std::ptrdiff_t kLongest = 3;
  const auto n = static_cast<std::ptrdiff_t>(tour.size());
  std::vector<std::size_t> changed;
  for (std::ptrdiff_t length = 1; length <= kLongest && length < n; ++length)
    for (std::ptrdiff_t i = 0; i + length <= n; ++i)
      for (std::ptrdiff_t to = 0; to + length <= n; ++to) {
        if (to == i) continue;
        changed = tour;
        const auto begin = changed.begin();
        if (to < i)
          std::rotate(begin + to, begin + i, begin + i + length);
        else
          std::rotate(begin + i, begin + i + length, begin + to + length);
        if (accept(costs, tour, cost, changed)) return true;
      }
  return false;
}

}  // namespace

double cost_of(const TourCosts& costs, const std::vector<std::size_t>& tour) {
  double at = 0.0, sum = 0.0, gains = 0.0;
  for (std::size_t i = 0; i < tour.size(); ++i) {
    at += i == 0 ? costs.first[tour[0]] : costs.between[tour[i - 1]][tour[i]];
    if (costs.gain.empty()) continue;
    sum += costs.gain[tour[i]] * at;
    gains += costs.gain[tour[i]];
  }
  return gains > 0.0 ? sum / gains + costs.beyond * at : at;
}

double seconds_of(const TourCosts& costs, const std::vector<std::size_t>& tour) {
  double at = 0.0;
  for (std::size_t i = 0; i < tour.size(); ++i)
    at += i == 0 ? costs.first[tour[0]] : costs.between[tour[i - 1]][tour[i]];
  return at;
}

std::vector<std::size_t> best_tour(const TourCosts& costs, int most_moves) {
  const std::size_t n = costs.first.size();
  std::vector<std::size_t> by_time(n);
  for (std::size_t i = 0; i < n; ++i) by_time[i] = i;
  std::stable_sort(by_time.begin(), by_time.end(),
                   [&](std::size_t a, std::size_t b) { return costs.first[a] < costs.first[b]; });
  std::vector<std::size_t> tour;
  for (const std::size_t stop : by_time) insert_best(costs, tour, stop);
  double cost = cost_of(costs, tour);
  for (int move = 0; move < most_moves; ++move)
    if (!turn_round(costs, tour, cost) && !move_piece(costs, tour, cost)) break;
  return tour;
}

}  // namespace ridgeway::detail
