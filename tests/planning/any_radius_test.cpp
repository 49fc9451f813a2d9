// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kWindowVoxel = 0.1, kSmallest = 0.2;

/// Two rooms behind a wall with two windows: a wide one far off, and one that robots pass up to a
/// radius of 1.75 times the smallest: between two of the levels that the cells know.
OccupancyMap rooms_with_two_windows() {
  return testing::make_map(kWindowVoxel, {0, 0, 0}, {61, 101, 15}, [](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 61 || v.y == 101 || v.z == 15;
    const bool near_window = v.y >= 12 && v.y < 19 && v.z >= 4 && v.z < 11;
    const bool far_window = v.y >= 80 && v.y < 95 && v.z >= 2 && v.z < 14;
    const bool wall = (v.x == 30 || v.x == 31) && !near_window && !far_window;
    return hull || wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(PlanAtAnyRadius, GoesThroughTheNearWindowAsLongAsTheRobotFits) {
  const Roadmap roadmap =
      build_roadmap(rooms_with_two_windows(), {.min_clearance = kSmallest}).roadmap;
  const Point start(1.0, 1.5, 0.7), goal(5.2, 1.7, 0.7);
  for (const double factor : {1.0, 1.1, 1.25, 1.3, 1.45, 1.51, 1.6, 1.74}) {
    const PlanResult result = plan(roadmap, start, goal, {.radius = factor * kSmallest});
    ASSERT_TRUE(result.ok()) << factor;
    EXPECT_LT(result.length, 5.0) << factor;
  }
  for (const double factor : {1.76, 1.9, 2.0}) {
    const PlanResult result = plan(roadmap, start, goal, {.radius = factor * kSmallest});
    ASSERT_TRUE(result.ok()) << factor;
    EXPECT_GT(result.length, 14.0) << factor;
  }
}

/// Rooms in a row, each joined with the next by four slits of 3 to 7 voxels.
OccupancyMap rooms_with_slits(unsigned seed) {
  std::mt19937 random(seed);
  std::array<std::array<int, 4>, 4> slits{};  // their widths, by wall
  for (std::array<int, 4>& wall : slits)
    for (int& width : wall) width = 3 + static_cast<int>(random() % 5);
  return testing::make_map(kWindowVoxel, {0, 0, 0}, {101, 81, 11}, [&](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 101 || v.y == 81 || v.z == 11;
    const bool wall = v.x % 20 == 0;
    const auto number = static_cast<std::size_t>(std::clamp(v.x / 20 - 1, 0, 3));
    const auto slit = static_cast<std::size_t>(std::min((v.y - 1) / 20, 3));
    const bool is_in_slit =
        wall && v.y > 0 && (v.y - 1) % 20 >= 8 && (v.y - 1) % 20 < 8 + slits[number][slit];
    return hull || (wall && !is_in_slit) ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

/// Two rooms behind a thick wall, with a slanting tunnel through it, and a wide window far off.
OccupancyMap rooms_with_a_tunnel(unsigned seed) {
  std::mt19937 random(seed);
  const auto share = [&] { return static_cast<double>(random() % 1000) / 1000.0; };
  const Point mouth(40.0, 14.0 + 8.0 * share(), 9.0 + 4.0 * share());
  const Point along = Point(1.0, share() - 0.5, 0.6 * share() - 0.3).normalized();
  const double width = 3.6 + 1.4 * share();
  return testing::make_map(kWindowVoxel, {0, 0, 0}, {96, 131, 23}, [&](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 96 || v.y == 131 || v.z == 23;
    const bool wall = v.x >= 40 && v.x < 56;
    const Point off = Point(v.x, v.y, v.z) - mouth;
    const bool tunnel = (off - off.dot(along) * along).norm() < width;
    const bool window = v.y >= 110;
    return hull || (wall && !tunnel && !window) ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(PlanAtAnyRadius, FindsSlantingTunnelsFromAfar) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Roadmap roadmap =
        build_roadmap(rooms_with_a_tunnel(seed), {.min_clearance = kSmallest}).roadmap;
    for (const double factor :
         {1.0, 1.1, 1.2, 1.25, 1.3, 1.4, 1.5, 1.55, 1.6, 1.7, 1.8, 1.9, 2.0}) {
      const double radius = factor * kSmallest;
      for (const double y : {1.2, 2.5}) {
        const Point start(1.0, y, 1.1), goal(8.6, 3.2 - y, 1.3);
        const PlanResult path = plan(roadmap, start, goal, {.radius = radius});
        const PlanResult judge =
            plan(roadmap, start, goal, {.planner = Planner::kEsdf, .radius = radius});
        ASSERT_TRUE(path.ok() && judge.ok());
        EXPECT_LE(path.length, 1.15 * judge.length) << "seed " << seed << ", factor " << factor;
      }
    }
  }
}

TEST(PlanAtAnyRadius, IsAboutAsShortAsAStarBetweenTheLevelsToo) {
  int bent = 0;
  double sum = 0.0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Roadmap roadmap = build_roadmap(rooms_with_slits(seed), {.min_clearance = 0.15}).roadmap;
    std::mt19937 random(seed);
    for (const double factor : {1.05, 1.3, 1.4, 1.6, 1.7, 1.95}) {
      const double radius = factor * roadmap.min_clearance;
      const std::vector<VoxelId> places = testing::traversable_places(roadmap.esdf, radius);
      const auto place = [&] {
        return centre_of(roadmap.esdf.layout.index_of(places[random() % places.size()]),
                         kWindowVoxel);
      };
      for (int i = 0; i < 12; ++i) {
        const Point start = place(), goal = place();
        const PlanResult path = plan(roadmap, start, goal, {.radius = radius});
        const PlanResult judge =
            plan(roadmap, start, goal, {.planner = Planner::kEsdf, .radius = radius});
        ASSERT_EQ(path.status, judge.status);
        if (!path.ok() || path.waypoints.size() == 2) continue;
        EXPECT_LE(path.length, 1.15 * judge.length) << "seed " << seed << ", factor " << factor;
        sum += path.length / std::min(path.length, judge.length);
        ++bent;
      }
    }
  }
  EXPECT_GT(bent, 200);
  EXPECT_LE(sum / bent, 1.01);
}

}  // namespace
}  // namespace ridgeway
