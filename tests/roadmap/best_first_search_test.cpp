// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap/best_first_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "common/random.hpp"

namespace ridgeway {
namespace {

using detail::BestFirstSearch;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNodes = 30;

/// Directed edges with values in (0, 1], few enough that some nodes cannot be reached.
struct Links {
  struct Link {
    std::uint32_t from, to;
    double value;
  };
  std::vector<Link> all;

  explicit Links(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 45; ++i)
      all.push_back({static_cast<std::uint32_t>(random.below(kNodes)),
                     static_cast<std::uint32_t>(random.below(kNodes)),
                     static_cast<double>(1 + random.below(8)) / 8.0});
  }

  template <typename Visit>
  void of(std::uint32_t v, const Visit& visit) const {
    for (const Link& link : all)
      if (link.from == v) visit(link.to, link.value);
  }

  /// The plain form: every edge again and again, until nothing gets better (Bellman and Ford).
  std::vector<double> lengths_from(std::uint32_t start) const {
    std::vector<double> lengths(kNodes, kFar);
    lengths[start] = 0.0;
    for (std::uint32_t round = 0; round < kNodes; ++round)
      for (const Link& link : all)
        lengths[link.to] = std::min(lengths[link.to], lengths[link.from] + link.value);
    return lengths;
  }
  std::vector<double> widths_from(std::uint32_t start) const {
    std::vector<double> widths(kNodes, 0.0);
    widths[start] = kFar;
    for (std::uint32_t round = 0; round < kNodes; ++round)
      for (const Link& link : all)
        widths[link.to] = std::max(widths[link.to], std::min(widths[link.from], link.value));
    return widths;
  }
  double value(std::uint32_t from, std::uint32_t to) const {
    double least = kFar;
    of(from, [&](std::uint32_t next, double value) {
      if (next == to) least = std::min(least, value);
    });
    return least;
  }
};

void run_dijkstra(const Links& links, BestFirstSearch<std::uint32_t, double>& search,
                  std::uint32_t start) {
  search.offer(start, 0.0, start);
  search.run([&](std::uint32_t v) {
    links.of(v, [&](std::uint32_t to, double own) { search.offer(to, search.cost(v) + own, v); });
    return true;
  });
}

TEST(BestFirstSearch, FindsTheShortestWaysAgainAndAgain) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Links links(seed);
    BestFirstSearch<std::uint32_t, double> search(kNodes, kFar);
    for (std::uint32_t start = 0; start < kNodes; ++start) {
      const std::vector<double> expected = links.lengths_from(start);
      search.restart();
      run_dijkstra(links, search, start);
      for (std::uint32_t v = 0; v < kNodes; ++v) {
        ASSERT_EQ(search.cost(v), expected[v]) << seed << ' ' << start << ' ' << v;
        ASSERT_EQ(search.is_reached(v), expected[v] < kFar);
      }
    }
  }
}

TEST(BestFirstSearch, WaysBackAreAsLongAsTheySay) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Links links(seed);
    BestFirstSearch<std::uint32_t, double> search(kNodes, kFar);
    run_dijkstra(links, search, 0);
    for (std::uint32_t v = 0; v < kNodes; ++v) {
      if (!search.is_reached(v)) continue;
      const std::vector<std::uint32_t> way = search.way_to(v);
      double length = 0.0;
      for (std::size_t i = 1; i < way.size(); ++i) length += links.value(way[i - 1], way[i]);
      EXPECT_EQ(way.front(), 0u);
      EXPECT_EQ(way.back(), v);
      EXPECT_EQ(length, search.cost(v));
    }
  }
}

TEST(BestFirstSearch, FindsTheWidestWaysWhereWiderIsLess) {
  struct Width {
    double value;
    bool operator<(const Width& other) const { return value > other.value; }
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Links links(seed);
    BestFirstSearch<std::uint32_t, Width> search(kNodes, {0.0});
    search.offer(0, {kFar}, 0);
    search.run([&](std::uint32_t v) {
      links.of(v, [&](std::uint32_t to, double own) {
        search.offer(to, {std::min(search.cost(v).value, own)}, v);
      });
      return true;
    });
    const std::vector<double> expected = links.widths_from(0);
    for (std::uint32_t v = 0; v < kNodes; ++v) ASSERT_EQ(search.cost(v).value, expected[v]);
  }
}

TEST(BestFirstSearch, EstimatesLeadToTheGoalAsShortAndSooner) {
  struct Estimate {
    double whole, cost;
    bool operator<(const Estimate& other) const { return whole < other.whole; }
  };
  std::size_t plain_visits = 0, guided_visits = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Links links(seed);
    std::vector<std::vector<double>> rest;  // exact, the best of estimates
    for (std::uint32_t v = 0; v < kNodes; ++v) rest.push_back(links.lengths_from(v));
    for (std::uint32_t goal = 1; goal < kNodes; ++goal) {
      BestFirstSearch<std::uint32_t, double, Estimate> search(kNodes, kFar);
      const auto offer = [&](std::uint32_t v, double cost, std::uint32_t from) {
        if (search.improve(v, cost, from)) search.enqueue(v, {cost + rest[v][goal], cost});
      };
      offer(0, 0.0, 0);
      search.run([&](std::uint32_t v) {
        if (rest[v][goal] == kFar) return false;
        ++guided_visits;
        links.of(v, [&](std::uint32_t to, double own) { offer(to, search.cost(v) + own, v); });
        return v != goal;
      });
      if (rest[0][goal] < kFar) {
        EXPECT_EQ(search.cost(goal), rest[0][goal]);
      }
      BestFirstSearch<std::uint32_t, double> plain(kNodes, kFar);
      plain.offer(0, 0.0, 0);
      plain.run([&](std::uint32_t v) {
        ++plain_visits;
        links.of(v, [&](std::uint32_t to, double own) { plain.offer(to, plain.cost(v) + own, v); });
        return v != goal;
      });
    }
  }
  EXPECT_LT(2 * guided_visits, plain_visits);
}

TEST(BestFirstSearch, TakesEqualOnesByTheirNumber) {
  BestFirstSearch<std::uint32_t, double> search(kNodes, kFar);
  for (const std::uint32_t v : {7u, 3u, 29u, 0u, 12u}) search.offer(v, 1.0, v);
  search.offer(20, 0.5, 20);
  std::vector<std::uint32_t> order;
  search.run([&](std::uint32_t v) {
    order.push_back(v);
    return v != 12;
  });
  EXPECT_EQ(order, (std::vector<std::uint32_t>{20, 0, 3, 7, 12}));
}

TEST(BestFirstSearch, AmongEqualWaysTheFirstOfferedStays) {
  BestFirstSearch<std::uint32_t, double> search(kNodes, kFar);
  search.offer(4, 1.0, 9);
  search.offer(4, 1.0, 2);
  EXPECT_EQ(search.from(4), 9u);
  search.offer(4, 0.5, 2);
  EXPECT_EQ(search.from(4), 2u);
}

}  // namespace
}  // namespace ridgeway
