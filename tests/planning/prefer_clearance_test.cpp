// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"

namespace ridgeway {
namespace {

using testing::kPillarClearance;
const Point kHallStart(0.5, 2.9, 0.4), kHallGoal(7.4, 3.1, 0.4);

double mean_clearance(const FreeSpace& space, const std::vector<Point>& path) {
  double sum = 0.0, length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double own = (path[i] - path[i - 1]).norm();
    constexpr int kPieces = 200;
    for (int k = 0; k < kPieces; ++k)
      sum += own / kPieces *
             space.distance(path[i - 1] + (path[i] - path[i - 1]) * ((k + 0.5) / kPieces));
    length += own;
  }
  return sum / length;
}

/// What a path costs, by the formula of PlanConfig, in small steps.
double cost_of(const FreeSpace& space, const std::vector<Point>& path, double radius, double w) {
  double cost = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    constexpr int kPieces = 500;
    const Point step = (path[i] - path[i - 1]) / kPieces;
    for (int k = 0; k < kPieces; ++k) {
      const double d = space.distance(path[i - 1] + (k + 0.5) * step);
      cost += step.norm() * (1.0 + w * (radius / d) * (radius / d));
    }
  }
  return cost;
}

/// A hall 1.4 m high with pillars.
Roadmap hall_of_pillars(unsigned seed) {
  std::vector<Eigen::Vector2d> axes;
  const OccupancyMap low = testing::pillars(seed, axes, 6);
  const OccupancyMap high =
      testing::make_map(0.1, {0, 0, 0}, {79, 59, 15}, [&](const VoxelIndex& v) {
        return v.z == 0 || v.z == 15 ? VoxelState::kOccupied : low.at({v.x, v.y, 3});
      });
  return build_roadmap(high, {.min_clearance = kPillarClearance}).roadmap;
}

TEST(PreferClearance, TradesLengthForDistanceFromWalls) {
  constexpr std::array kWeights{0.0, 0.3, 1.0, 3.0, 10.0};
  std::array<double, kWeights.size()> mean{}, least{}, length{};
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Roadmap roadmap = hall_of_pillars(seed);
    const FreeSpace space(roadmap.esdf);
    std::vector<PlanResult> results;
    for (std::size_t i = 0; i < kWeights.size(); ++i) {
      const PlanResult result = plan(roadmap, kHallStart, kHallGoal,
                                     {.radius = kPillarClearance, .prefer_clearance = kWeights[i]});
      ASSERT_TRUE(result.ok());
      EXPECT_GE(space.clearance(result.waypoints), kPillarClearance * (1.0 - 1e-9));
      mean[i] += mean_clearance(space, result.waypoints);
      least[i] += result.clearance;
      length[i] += result.length;
      results.push_back(result);
      // No dearer than what asks for no clearance at all.
      EXPECT_LE(cost_of(space, result.waypoints, kPillarClearance, kWeights[i]),
                1.01 * cost_of(space, results[0].waypoints, kPillarClearance, kWeights[i]));
    }
  }
  for (std::size_t i = 1; i < kWeights.size(); ++i) {
    EXPECT_GE(mean[i], mean[i - 1]);
    EXPECT_GE(least[i], least[i - 1]);
    EXPECT_GE(length[i], length[i - 1]);
  }
  EXPECT_GT(mean.back(), 1.2 * mean.front());
  EXPECT_GT(length.back(), length.front());
}

TEST(PreferClearance, RefusesBadWeights) {
  const Roadmap roadmap = hall_of_pillars(0);
  for (const double bad :
       {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e308, 1e100, 1.1e6})
    EXPECT_THROW(plan(roadmap, kHallStart, kHallGoal, {.prefer_clearance = bad}), InputError);
}

TEST(PreferClearance, AnAnswerThatIsOkHasAPathOfFiniteLengthAtAnyWeight) {
  const Roadmap roadmap = hall_of_pillars(0);
  for (const double weight : {1e-300, 1e3, 1e6})
    for (const Planner planner : {Planner::kGraph, Planner::kDiagram, Planner::kEsdf})
      for (const bool shorten : {true, false}) {
        const PlanResult result =
            plan(roadmap, kHallStart, kHallGoal,
                 {.planner = planner, .shorten = shorten, .prefer_clearance = weight});
        ASSERT_TRUE(result.ok());
        ASSERT_GE(result.waypoints.size(), 2u);
        EXPECT_TRUE(std::isfinite(result.length));
        EXPECT_TRUE(std::isfinite(result.clearance));
      }
}

TEST(PreferClearance, SaysWhatAnswered) {
  const Roadmap roadmap = hall_of_pillars(3);
  const Point start(0.5, 2.9, 0.4), goal(7.4, 3.1, 0.4);
  for (const Planner planner : {Planner::kGraph, Planner::kDiagram, Planner::kEsdf}) {
    const PlanResult result =
        plan(roadmap, start, goal, {.planner = planner, .prefer_clearance = 3.0});
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result.answered_by, planner);
    EXPECT_GT(result.seconds.search, 0.0);
    EXPECT_GT(result.seconds.shorten, 0.0);
    EXPECT_LE(result.seconds.attach + result.seconds.search + result.seconds.shorten,
              result.seconds.total);
  }
}

}  // namespace
}  // namespace ridgeway
