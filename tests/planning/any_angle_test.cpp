// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planning/any_angle_search.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::Deadline;
using detail::LatticePath;
using detail::SearchStatus;

const Deadline kNoDeadline(std::numeric_limits<double>::infinity());
constexpr double kAnyLength = std::numeric_limits<double>::infinity();

Point centre(const EsdfMap& esdf, VoxelId id) {
  return centre_of(esdf.layout.index_of(id), esdf.voxel_size);
}

/// Every turn in sight of the one before, and the cost their distances, voxels.
void expect_legal(const EsdfMap& esdf, const LatticePath& path, VoxelId start, VoxelId goal,
                  double radius) {
  const FreeSpace space(esdf);
  ASSERT_EQ(path.voxels.front(), start);
  ASSERT_EQ(path.voxels.back(), goal);
  double length = 0.0;
  for (std::size_t i = 1; i < path.voxels.size(); ++i) {
    const Point a = centre(esdf, path.voxels[i - 1]), b = centre(esdf, path.voxels[i]);
    ASSERT_TRUE(space.is_free(a, b, radius));
    length += (b - a).norm() / esdf.voxel_size;
  }
  ASSERT_NEAR(path.cost, length, 1e-9);
  ASSERT_GE(path.cost, (centre(esdf, goal) - centre(esdf, start)).norm() / esdf.voxel_size - 1e-9);
}

/// Shortest lengths, voxels, over straight lines between any two voxels in sight: the least that
/// any path with turns at voxel centres can have.
std::vector<double> shortest_by_sight(const EsdfMap& esdf, const std::vector<VoxelId>& places,
                                      std::size_t start, double radius) {
  const FreeSpace space(esdf);
  std::vector<double> cost(places.size(), kAnyLength);
  std::vector<bool> done(places.size(), false);
  cost[start] = 0.0;
  for (;;) {
    std::size_t best = places.size();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!done[i] && cost[i] < kAnyLength && (best == places.size() || cost[i] < cost[best]))
        best = i;
    if (best == places.size()) return cost;
    done[best] = true;
    const Point from = centre(esdf, places[best]);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (done[i]) continue;
      const Point to = centre(esdf, places[i]);
      const double length = cost[best] + (to - from).norm() / esdf.voxel_size;
      if (length < cost[i] && space.is_free(from, to, radius)) cost[i] = length;
    }
  }
}

TEST(ThetaStar, FindsPathsWhereTheLatticeDoesAndHardlyEverLongerOnes) {
  int routes = 0, longer = 0;
  double worst = 0.0, sum_theta = 0.0, sum_lattice = 0.0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed), {.unknown = policy});
    for (const double radius : {0.1, 0.125, 0.2}) {
      const std::vector<VoxelId> places = testing::traversable_places(esdf, radius);
      if (places.empty()) continue;
      for (std::size_t k = 0; k < 12; ++k) {
        const VoxelId start = places[k * 7919 % places.size()];
        const VoxelId goal = places[(k * 31 + 104729 * seed) % places.size()];
        const LatticePath lattice =
            detail::search_lattice(esdf, start, goal, radius, {}, kNoDeadline);
        const LatticePath theta = detail::search_any_angle(esdf, start, goal, radius, kNoDeadline);
        ASSERT_EQ(theta.status, lattice.status);
        if (theta.status != SearchStatus::kFound) continue;
        expect_legal(esdf, theta, start, goal, radius);
        if (HasFatalFailure()) return;
        ++routes;
        longer += theta.cost > lattice.cost + 1e-9;
        worst = std::max(worst, lattice.cost > 0.0 ? theta.cost / lattice.cost : 1.0);
        sum_theta += theta.cost;
        sum_lattice += lattice.cost;
      }
    }
  }
  EXPECT_GT(routes, 500);
  // No theorem: 3 of 1511 routes, at most 2.3%; 6.4% shorter on the whole.
  EXPECT_LE(100 * longer, routes);
  EXPECT_LE(worst, 1.05);
  EXPECT_LE(sum_theta, 0.95 * sum_lattice);
}

TEST(ThetaStar, IsNeverShorterThanTheShortestByTurnsAtVoxels) {
  int routes = 0;
  double sum = 0.0, worst = 1.0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed, 12));
    const double radius = 0.1;
    const std::vector<VoxelId> places = testing::traversable_places(esdf, radius);
    if (places.size() < 10 || places.size() > 400) continue;
    const std::size_t start = seed % places.size();
    const std::vector<double> shortest = shortest_by_sight(esdf, places, start, radius);
    for (std::size_t goal = 0; goal < places.size(); goal += 7) {
      const LatticePath theta =
          detail::search_any_angle(esdf, places[start], places[goal], radius, kNoDeadline);
      if (theta.status != SearchStatus::kFound || shortest[goal] == 0.0) continue;
      ++routes;
      ASSERT_GE(theta.cost, shortest[goal] - 1e-9);
      worst = std::max(worst, theta.cost / shortest[goal]);
      sum += theta.cost / shortest[goal];
    }
  }
  EXPECT_GT(routes, 200);
  EXPECT_LE(sum, 1.01 * routes);
  EXPECT_LE(worst, 1.15);
}

TEST(ThetaStar, PlansVerifiedPathsThatTurnAtObstaclesOnly) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {59, 39, 19}, [](const VoxelIndex& v) {
    return v.x / 2 == 15 && v.y < 30 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.2}).roadmap;
  const Point start(0.73, 1.0, 1.02), goal(5.21, 0.6, 1.31);
  PlanConfig config{.planner = Planner::kThetaStar, .shorten = false};
  const PlanResult theta = plan(roadmap, start, goal, config);
  ASSERT_TRUE(theta.ok());
  EXPECT_EQ(theta.answered_by, Planner::kThetaStar);
  EXPECT_GE(theta.clearance, 0.2 * (1 - 1e-9));
  EXPECT_LE(theta.waypoints.size(), 8u);  // the ends, their voxels, turns about the wall's edge
  config.planner = Planner::kEsdf;
  EXPECT_LT(theta.length, 0.97 * plan(roadmap, start, goal, config).length);
  config = {.planner = Planner::kThetaStar, .shorten = true};
  EXPECT_LE(plan(roadmap, start, goal, config).length, theta.length + 1e-9);
}

TEST(ThetaStar, StopsAtItsDeadline) {
  const OccupancyMap map =
      testing::make_map(0.05, {0, 0, 0}, {79, 79, 79}, [](const VoxelIndex& v) {
        return v.x == 40 ? VoxelState::kOccupied : VoxelState::kFree;  // two rooms
      });
  const EsdfMap esdf = compute_esdf(map);
  const VoxelId start = esdf.layout.find({10, 40, 40}), goal = esdf.layout.find({70, 40, 40});
  EXPECT_EQ(detail::search_any_angle(esdf, start, goal, 0.1, Deadline(0.0)).status,
            SearchStatus::kTimeout);
}

}  // namespace
}  // namespace ridgeway
