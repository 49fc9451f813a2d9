// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Maps whose distances stop somewhere are planned in as those that know them all.
#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kSide = 0.1;  // of a voxel, metres
constexpr int kExtent = 20;    // of a room, voxels

/// A room of free voxels with rods of three to eight voxels along any axis.
OccupancyMap room_of_rods(unsigned seed, int rods) {
  std::mt19937 random(seed);
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  OccupancyMap map = testing::make_map(kSide, {0, 0, 0}, {kExtent - 1, kExtent - 1, kExtent - 1},
                                       [](const VoxelIndex&) { return VoxelState::kFree; });
  for (int rod = 0; rod < rods; ++rod) {
    VoxelIndex at{below(kExtent), below(kExtent), below(kExtent)};
    const int axis = below(3), length = 3 + below(6);
    for (int k = 0; k < length; ++k) {
      if (std::max({at.x, at.y, at.z}) < kExtent)
        map.state[map.layout.find(at)] = VoxelState::kOccupied;
      ++(axis == 0 ? at.x : axis == 1 ? at.y : at.z);
    }
  }
  return map;
}

Roadmap build_within(const OccupancyMap& map, double radius, double max_distance) {
  return build_roadmap(map, {.min_clearance = radius, .max_distance = max_distance}).roadmap;
}

Point any_centre(std::mt19937& random) {
  Point p;
  for (double& x : p) x = kSide * (0.5 + static_cast<double>(random() % kExtent));
  return p;
}

TEST(MaxDistance, PathsAreNoLonger) {
  std::mt19937 random(5);
  int compared = 0;
  for (unsigned seed = 0; seed < 16; ++seed) {
    const OccupancyMap map = room_of_rods(seed, 30);
    const double radius = kSide * (seed % 2 == 0 ? 1.0 : 1.4);
    const Roadmap whole = build_roadmap(map, {.min_clearance = radius}).roadmap;
    for (const double more : {2.05, 2.3, 2.51, 3.0}) {
      const Roadmap bounded = build_within(map, radius, radius + more * kSide);
      for (int i = 0; i < 40; ++i) {
        const Point start = any_centre(random), goal = any_centre(random);
        const PlanResult far = plan(whole, start, goal), near = plan(bounded, start, goal);
        ASSERT_EQ(far.status, near.status);
        if (!far.ok()) continue;
        EXPECT_LE(near.length, 1.15 * far.length)
            << seed << ' ' << more << ": " << start.transpose() << " to " << goal.transpose();
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 800);
}

TEST(MaxDistance, TallCylindersPassWhereTheyFit) {
  std::mt19937 random(6);
  int passed = 0, refused = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const OccupancyMap map = room_of_rods(seed, 8);
    const Roadmap whole = build_roadmap(map, {.min_clearance = kSide}).roadmap;
    const Roadmap bounded = build_within(map, kSide, 3.5 * kSide);
    for (int i = 0; i < 60; ++i) {
      const Point start = any_centre(random), goal = any_centre(random);
      const PlanConfig config{.robot_height = kSide * (6.0 + static_cast<double>(random() % 8))};
      const PlanResult far = plan(whole, start, goal, config);
      ASSERT_EQ(plan(bounded, start, goal, config).status, far.status)
          << seed << ": " << start.transpose() << " to " << goal.transpose();
      passed += far.ok();
      refused += far.status == PlanStatus::kStartInCollision;
    }
  }
  EXPECT_GT(passed, 50);
  EXPECT_GT(refused, 20);
}

// 0.6 - 2 * 0.1 is less than 0.4 by rounding.
TEST(MaxDistance, HoldsARadiusTwoVoxelsBelowIt) {
  const Roadmap roadmap = build_within(room_of_rods(1, 0), 0.4, 0.6);
  EXPECT_TRUE(plan(roadmap, Point(0.55, 0.55, 0.55), Point(1.4, 1.3, 0.9), {.radius = 0.4}).ok());
  const Roadmap smaller = build_within(room_of_rods(1, 0), 0.2, 0.6);
  EXPECT_TRUE(plan(smaller, Point(0.55, 0.55, 0.55), Point(1.4, 1.3, 0.9), {.radius = 0.4}).ok());
  EXPECT_THROW(plan(smaller, Point(0.55, 0.55, 0.55), Point(1.4, 1.3, 0.9), {.radius = 0.41}),
               InputError);
}

}  // namespace
}  // namespace ridgeway
