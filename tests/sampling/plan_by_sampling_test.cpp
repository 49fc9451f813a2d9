// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sampling/plan_by_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <thread>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "sampling/two_rooms.hpp"
#include "support/brute_force.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::iterations_of;
using testing::kLeft;
using testing::kRadius;
using testing::kRight;
using testing::kSamplers;
using testing::limited;
using testing::two_rooms;

constexpr std::array kGoalSeekers{Planner::kRrtStar, Planner::kBitStar, Planner::kPrmStar,
                                  Planner::kInformedRrtStar};
/// From kLeft over the rounded corners of the inflated wall to kRight, in the plane z = 1.
double shortest_length() {
  const double dx = 2.0, dy = 2.4, r = kRadius * (1 - 1e-9);  // from an end to its corner's centre
  const double hypotenuse = std::hypot(dx, dy);
  const double tangent = std::sqrt(hypotenuse * hypotenuse - r * r);
  const double angle = std::atan2(dx, dy) - std::asin(r / hypotenuse);  // of the tangent to y
  const double turn = std::acos(-1.0) / 2 - angle;  // from there to x, along the wall's end
  return 2.0 * (tangent + r * turn) + 0.2;
}

/// Looks at a path point by point, knowing obstacle cubes and voxel states alone.
void expect_free(const OccupancyMap& map, UnknownPolicy policy, const std::vector<Point>& path,
                 double radius, const std::vector<VoxelIndex>& obstacles) {
  const double s = map.voxel_size, least = radius / s * (1.0 - 1e-6);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int pieces = 1 + static_cast<int>((path[i] - path[i - 1]).norm() / (0.2 * s));
    for (int k = 0; k <= pieces; ++k) {
      const Point p = path[i - 1] + (path[i] - path[i - 1]) * (static_cast<double>(k) / pieces);
      ASSERT_GE(testing::brute_squared_distance(p / s, obstacles), least * least);
      if (policy == UnknownPolicy::kIgnore) {
        ASSERT_EQ(map.at(voxel_at(p, s)), VoxelState::kFree);
      }
    }
  }
}

TEST(Sampling, PathsOfEveryPlannerKeepTheirClearanceOnRandomMaps) {
  int paths = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const OccupancyMap map = testing::random_map(seed);
    const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
    const std::vector<VoxelIndex> obstacles = testing::all_obstacles(map, policy);
    const double radius = seed % 2 == 0 ? 0.1 : 0.125;
    const std::vector<VoxelId> places = testing::traversable_places(esdf, radius);
    if (places.empty()) continue;
    std::mt19937 random(seed);
    for (const Planner planner : kSamplers) {
      SamplingConfig config = limited(planner, 400, seed);
      config.radius = radius;
      config.shorten = seed % 4 < 2;
      const auto place = [&] {
        return centre_of(esdf.layout.index_of(places[random() % places.size()]), 0.1);
      };
      const Point start = place(), goal = place();
      const SamplingResult result = plan_by_sampling(esdf, start, goal, config);
      if (!result.plan.ok()) {
        ASSERT_EQ(result.plan.status, PlanStatus::kTimeout);
        ASSERT_TRUE(result.plan.waypoints.empty());
        continue;
      }
      ++paths;
      EXPECT_EQ(result.plan.answered_by, planner);
      EXPECT_EQ(result.plan.waypoints.front(), start);
      EXPECT_EQ(result.plan.waypoints.back(), goal);
      EXPECT_GE(result.plan.length, (goal - start).norm() * (1.0 - 1e-12));
      EXPECT_GE(result.first_length, result.plan.length * (1.0 - 1e-9));
      EXPECT_GE(result.plan.clearance, radius * (1.0 - 1e-9));
      expect_free(map, policy, result.plan.waypoints, radius, obstacles);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(paths, 60);
}

TEST(Sampling, OptimalPlannersComeCloseToTheShortestPathAndNeverBelowIt) {
  const EsdfMap esdf = compute_esdf(two_rooms(false));
  const double shortest = shortest_length();
  for (const Planner planner : kSamplers) {
    SCOPED_TRACE(name_of(planner));
    SamplingConfig config = limited(planner, iterations_of(planner, 3000));
    config.shorten = false;
    const SamplingResult best = plan_by_sampling(esdf, kLeft, kRight, config);
    ASSERT_TRUE(best.plan.ok());
    EXPECT_GE(best.plan.length, shortest * (1.0 - 1e-6));
    EXPECT_LE(best.plan.length, best.first_length * (1.0 + 1e-12));
    if (planner != Planner::kRrtConnect) {
      EXPECT_LE(best.plan.length, 1.05 * shortest);
    }
    config.shorten = true;
    EXPECT_LE(plan_by_sampling(esdf, kLeft, kRight, config).plan.length, 1.02 * shortest);
  }
}

TEST(Sampling, RefusesAPlannerThatIsNone) {
  SamplingConfig config = limited(Planner::kRrtConnect, 10);
  config.planner = static_cast<Planner>(200);
  EXPECT_THROW(config.validate(), InputError);
}

TEST(Sampling, FirstSolutionEndsTheSearchWithTheFirstPath) {
  const EsdfMap esdf = compute_esdf(two_rooms(false));
  for (const Planner planner : kSamplers) {
    SCOPED_TRACE(name_of(planner));
    SamplingConfig config = limited(planner, 3000);
    config.shorten = false;
    const SamplingResult all = plan_by_sampling(esdf, kLeft, kRight, config);
    config.first_solution = true;
    const SamplingResult first = plan_by_sampling(esdf, kLeft, kRight, config);
    ASSERT_TRUE(first.plan.ok());
    EXPECT_LT(first.iterations, 2000u);
    EXPECT_NEAR(first.plan.length, first.first_length, 1e-9);
    EXPECT_NEAR(first.first_length, all.first_length, 1e-9);
    if (planner != Planner::kRrtConnect) {
      EXPECT_GE(all.iterations, 3000u);
    }
  }
}

TEST(Sampling, SameSeedGivesTheSamePathWhateverRunsBeside) {
  const EsdfMap esdf = compute_esdf(two_rooms(false));
  for (const Planner planner : kSamplers) {
    SCOPED_TRACE(name_of(planner));
    std::array<std::vector<Point>, 4> serial, parallel;
    const auto run = [&](std::size_t k) {
      return plan_by_sampling(esdf, kLeft, kRight, limited(planner, iterations_of(planner, 600), k))
          .plan.waypoints;
    };
    for (std::size_t k = 0; k < serial.size(); ++k) serial[k] = run(k);
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < parallel.size(); ++k)
      threads.emplace_back([&, k] { parallel[k] = run(k); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(serial, parallel);
    EXPECT_NE(serial[0], serial[1]);
    EXPECT_NE(serial[1], serial[2]);
  }
}

TEST(Sampling, FindsNothingThroughAWallAndSaysThatTheLimitPassed) {
  const EsdfMap esdf = compute_esdf(two_rooms(true));
  for (const Planner planner : kSamplers) {
    SCOPED_TRACE(name_of(planner));
    const SamplingResult result = plan_by_sampling(esdf, kLeft, kRight, limited(planner, 300));
    EXPECT_EQ(result.plan.status, PlanStatus::kTimeout);
    SamplingConfig timed = limited(planner, 300);
    timed.iteration_limit = std::numeric_limits<std::size_t>::max();
    timed.time_limit = 0.02;
    const SamplingResult late = plan_by_sampling(esdf, kLeft, kRight, timed);
    EXPECT_EQ(late.plan.status, PlanStatus::kTimeout);
    EXPECT_GE(late.plan.seconds.total, 0.02);
    EXPECT_LT(late.plan.seconds.search, 0.5);
  }
}

TEST(Sampling, ReachesTheOutermostPlacesOfTheMap) {
  int queries = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = seed % 2 == 0 ? UnknownPolicy::kIgnore : UnknownPolicy::kObstacle;
    const EsdfMap esdf = compute_esdf(testing::random_map(seed), {.unknown = policy});
    const double radius = 0.05;  // fits at the centre of every free voxel
    const FreeSpace space(esdf);
    const std::vector<VoxelId> places = testing::traversable_places(esdf, radius);
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const auto reach = [&](VoxelId id) {
          return sign * centre_of(esdf.layout.index_of(id), 0.1)[axis];
        };
        const VoxelId start =
            *std::max_element(places.begin(), places.end(),
                              [&](VoxelId a, VoxelId b) { return reach(a) < reach(b); });
        const Point from = centre_of(esdf.layout.index_of(start), 0.1);
        for (int d = 0; d < 27; ++d) {
          const Point to = from + centre_of(offset_of(d), 0.1) - Point::Constant(0.05);
          if (d == kCentre || !space.is_free(from, to, radius)) continue;
          ++queries;
          // RRT-Connect alone does not sample the goal: of a slit without volume it knows nothing.
          SamplingConfig config = limited(kGoalSeekers[static_cast<std::size_t>(d % 4)], 2000);
          config.radius = radius;
          config.first_solution = true;
          config.shorten = false;
          EXPECT_TRUE(plan_by_sampling(esdf, from, to, config).plan.ok());
        }
      }
  }
  EXPECT_GT(queries, 500);
}

/// Coordinates that rounding puts a little outside are inside the limits, for OMPL too.
TEST(Sampling, StartsAndGoalsMayLieOnTheFacesOfTheLimits) {
  const EsdfMap esdf = compute_esdf(two_rooms(false));
  const Point outside(0.0, 0.0, 9e-9);
  for (const Planner planner : kSamplers) {
    SCOPED_TRACE(name_of(planner));
    SamplingConfig config = limited(planner, iterations_of(planner, 20000));
    config.limits.keep_in.max.z() = kLeft.z();
    config.first_solution = true;
    EXPECT_TRUE(plan_by_sampling(esdf, kLeft + outside, kRight, config).plan.ok());
    EXPECT_TRUE(plan_by_sampling(esdf, kLeft, kRight + outside, config).plan.ok());
  }
}

TEST(Sampling, SolvesTheTrivialQueries) {
  const EsdfMap esdf = compute_esdf(two_rooms(false));
  for (const Planner planner : kSamplers) {
    SCOPED_TRACE(name_of(planner));
    SamplingConfig config = limited(planner, 5000);
    const SamplingResult here = plan_by_sampling(esdf, kLeft, kLeft, config);
    EXPECT_TRUE(here.plan.ok());
    EXPECT_EQ(here.plan.length, 0.0);
    const Point near = kLeft + Point(0.5, 0.3, 0.2);
    const SamplingResult straight = plan_by_sampling(esdf, kLeft, near, config);
    ASSERT_TRUE(straight.plan.ok());
    EXPECT_NEAR(straight.plan.length, (near - kLeft).norm(), 1e-9);
    EXPECT_EQ(straight.iterations, 0u);
    EXPECT_EQ(straight.first_length, straight.plan.length);
  }
}

/// As plan() does: where no voxel's centre is free but the goal is in sight.
TEST(PlanBySampling, GoesStraightThroughASlotWithoutACentre) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {39, 39, 19}, [](const VoxelIndex& v) {
    const bool is_shell = v.x == 0 || v.z == 0 || v.x == 39 || v.z == 19;
    return is_shell || (v.y != 30 && v.y != 31) ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const SamplingConfig config{.planner = Planner::kRrtConnect, .radius = 0.09};
  const SamplingResult straight =
      plan_by_sampling(compute_esdf(map), {0.5, 3.1, 1.0}, {3.0, 3.1, 1.0}, config);
  ASSERT_TRUE(straight.plan.ok()) << name_of(straight.plan.status);
  EXPECT_NEAR(straight.plan.length, 2.5, 1e-12);
  const SamplingResult off =
      plan_by_sampling(compute_esdf(map), {0.5, 3.12, 1.0}, {3.0, 3.1, 1.0}, config);
  EXPECT_EQ(off.plan.status, PlanStatus::kStartInCollision);
}

TEST(PlanBySampling, AMapOfNothingHasNoPlace) {
  const SamplingConfig config{.planner = Planner::kRrtConnect, .radius = 0.09};
  OccupancyMap nothing;
  nothing.voxel_size = 0.1;
  EXPECT_EQ(plan_by_sampling(compute_esdf(nothing), {0, 0, 0}, {1, 0, 0}, config).plan.status,
            PlanStatus::kStartOutsideMap);
}

}  // namespace
}  // namespace ridgeway
