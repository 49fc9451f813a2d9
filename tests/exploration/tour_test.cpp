// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/random.hpp"

namespace ridgeway {
namespace {

detail::TourCosts random_costs(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x, y;
  for (std::size_t i = 0; i <= n; ++i) {
    x.push_back(random.uniform());
    y.push_back(random.uniform());
  }
  const auto between = [&](std::size_t a, std::size_t b) {
    return std::hypot(x[a] - x[b], y[a] - y[b]);
  };
  detail::TourCosts costs;
  for (std::size_t i = 0; i < n; ++i) {
    costs.first.push_back(between(n, i));
    costs.between.emplace_back();
    for (std::size_t j = 0; j < n; ++j) costs.between[i].push_back(between(i, j));
  }
  return costs;
}

TEST(Tour, IsNearTheShortestOfAllOrders) {
  double worst = 1.0, sum = 0.0;
  constexpr int kCases = 60;
  for (int seed = 1; seed <= kCases; ++seed) {
    const detail::TourCosts costs = random_costs(7, static_cast<std::uint64_t>(seed));
    const std::vector<std::size_t> tour = detail::best_tour(costs);
    std::vector<std::size_t> order(7);
    std::iota(order.begin(), order.end(), std::size_t{0});
    ASSERT_TRUE(std::is_permutation(tour.begin(), tour.end(), order.begin()));
    double best = 1e9;
    do best = std::min(best, detail::cost_of(costs, order));
    while (std::next_permutation(order.begin(), order.end()));
    const double ratio = detail::cost_of(costs, tour) / best;
    EXPECT_GE(ratio, 1.0 - 1e-12);
    worst = std::max(worst, ratio);
    sum += ratio;
  }
  EXPECT_LT(worst, 1.12);
  EXPECT_LT(sum / kCases, 1.01);
}

TEST(Tour, WithGainsIsNearTheBestOfAllOrders) {
  double sum = 0.0;
  constexpr int kCases = 40;
  for (int seed = 1; seed <= kCases; ++seed) {
    detail::TourCosts costs = random_costs(6, static_cast<std::uint64_t>(seed));
    Random random(static_cast<std::uint64_t>(seed), 2);
    for (int i = 0; i < 6; ++i) costs.gain.push_back(random.uniform(1.0, 20.0));
    std::vector<std::size_t> order(6);
    std::iota(order.begin(), order.end(), std::size_t{0});
    double best = 1e9;
    do best = std::min(best, detail::cost_of(costs, order));
    while (std::next_permutation(order.begin(), order.end()));
    const double ratio = detail::cost_of(costs, detail::best_tour(costs)) / best;
    EXPECT_GE(ratio, 1.0 - 1e-12);
    EXPECT_LT(ratio, 1.2);
    sum += ratio;
  }
  EXPECT_LT(sum / kCases, 1.01);
}

TEST(Tour, LargeGainsComeBeforeNearScraps) {
  detail::TourCosts costs;
  costs.first = {1.0, 3.0};
  costs.between = {{0.0, 4.0}, {4.0, 0.0}};
  const std::vector<std::size_t> near_first{0, 1}, far_first{1, 0};
  EXPECT_EQ(detail::best_tour(costs), near_first);
  costs.gain = {1.0, 1.0};
  EXPECT_EQ(detail::best_tour(costs), near_first);
  costs.gain = {1.0, 100.0};
  EXPECT_EQ(detail::best_tour(costs), far_first);
}

TEST(Tour, OfNothingAndOfOne) {
  EXPECT_TRUE(detail::best_tour({}).empty());
  EXPECT_EQ(detail::best_tour(random_costs(1, 1)), std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace ridgeway
