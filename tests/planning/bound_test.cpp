// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "roadmap/cell_search.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kBoundVoxel = 0.1, kBoundRadius = 0.1;

/// A box of free space with random obstacles.
Roadmap roadmap_of_boxes(std::mt19937& random) {
  std::vector<std::array<VoxelIndex, 2>> boxes;
  for (int i = 0; i < 7; ++i) {
    const auto at = [&](int most) {
      return 1 + static_cast<int>(random() % static_cast<unsigned>(most));
    };
    const VoxelIndex low{at(12), at(12), at(7)};
    boxes.push_back({low, low + VoxelIndex{at(5), at(5), at(5)}});
  }
  const OccupancyMap map =
      testing::make_map(kBoundVoxel, {0, 0, 0}, {14, 14, 9}, [&](const VoxelIndex& v) {
        const bool is_solid = std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
          return v.x >= box[0].x && v.x < box[1].x && v.y >= box[0].y && v.y < box[1].y &&
                 v.z >= box[0].z && v.z < box[1].z;
        });
        return is_solid ? VoxelState::kOccupied : VoxelState::kFree;
      });
  return build_roadmap(map, {.min_clearance = kBoundRadius}).roadmap;
}

/// The shortest path over all traversable voxel centres that see each other: an upper bound on the
/// shortest path of all, which a false lower bound would have to stay below.
double shortest_over_centres(const Roadmap& roadmap, const std::vector<VoxelId>& places,
                             std::size_t start, std::size_t goal) {
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  std::vector<Point> at;
  at.reserve(places.size());
  for (const VoxelId id : places)
    at.push_back(centre_of(esdf.layout.index_of(id), esdf.voxel_size));
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> cost(at.size(), kFar);
  std::vector<bool> is_done(at.size());
  cost[start] = 0.0;
  for (;;) {  // A*
    std::size_t best = at.size();
    const auto estimate = [&](std::size_t i) { return cost[i] + (at[i] - at[goal]).norm(); };
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!is_done[i] && cost[i] < kFar && (best == at.size() || estimate(i) < estimate(best)))
        best = i;
    if (best == at.size() || best == goal) return cost[goal];
    is_done[best] = true;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (const double own = cost[best] + (at[i] - at[best]).norm();
          own < cost[i] && space.is_free(at[best], at[i], kBoundRadius))
        cost[i] = own;
  }
}

TEST(Within, HoldsAgainstTheShortestPathByBruteForce) {
  std::mt19937 random(1);
  int bent = 0, shorter_by_more = 0;
  for (int map = 0; map < 12; ++map) {
    SCOPED_TRACE(map);
    const Roadmap roadmap = roadmap_of_boxes(random);
    const EsdfMap& esdf = roadmap.esdf;
    const std::vector<VoxelId> places = testing::traversable_places(esdf, kBoundRadius);
    for (int i = 0; i < 5; ++i) {
      const std::size_t from = random() % places.size(), to = random() % places.size();
      const Point start =
          to_world(esdf, centre_of(esdf.layout.index_of(places[from]), kBoundVoxel));
      const Point goal = to_world(esdf, centre_of(esdf.layout.index_of(places[to]), kBoundVoxel));
      const double shortest = shortest_over_centres(roadmap, places, from, to);
      const PlanResult usual = plan(roadmap, start, goal);
      const PlanResult best = plan(roadmap, start, goal, {.within = PlanConfig::kBestWithin});
      ASSERT_EQ(usual.ok(), !std::isinf(shortest));
      ASSERT_EQ(best.ok(), usual.ok());
      if (!usual.ok()) continue;
      for (const PlanResult* result : {&usual, &best}) {
        EXPECT_GE(result->within, 1.0);
        EXPECT_LE(result->length, result->within * shortest * (1.0 + 1e-9));
      }
      const PlanResult exact = plan(roadmap, start, goal, {.planner = Planner::kEsdf});
      const PlanResult theta = plan(roadmap, start, goal, {.planner = Planner::kThetaStar});
      EXPECT_LE(usual.length, 1.15 * exact.length);
      EXPECT_LE(best.length, usual.length * (1.0 + 1e-9));
      if (best.within > PlanConfig::kBestWithin) {
        EXPECT_LE(best.length, 1.01 * theta.length);
      }
      bent += usual.waypoints.size() > 2;
      shorter_by_more += best.length < 0.999 * usual.length;
    }
  }
  EXPECT_GT(bent, 25);
  EXPECT_GT(shorter_by_more, 0);
}

/// Voxels of 1 m, three tenths of them occupied, for a robot that just fits between: ways of equal
/// length past each other on all sides, of which cells of four voxels know few as short as they
/// are.
OccupancyMap clutter(unsigned seed) {
  std::mt19937 random(seed);
  return testing::make_map(1.0, {0, 0, 0}, {27, 27, 27}, [&](const VoxelIndex&) {
    return random() % 10 < 3 ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(ShortPaths, ThroughClutterAreHardlyLongerThanOverAllVoxels) {
  const Roadmap roadmap = build_roadmap(clutter(0), {.min_clearance = 0.5}).roadmap;
  const std::vector<VoxelId> places = testing::traversable_places(roadmap.esdf, 0.5);
  std::mt19937 random(0);
  int paths = 0;
  double sum = 0.0;
  for (int i = 0; i < 60; ++i) {
    const auto place = [&] {
      const VoxelId id = places[random() % places.size()];
      return to_world(roadmap.esdf, centre_of(roadmap.esdf.layout.index_of(id), 1.0));
    };
    const Point start = place(), goal = place();
    const PlanResult usual = plan(roadmap, start, goal);
    if (!usual.ok()) continue;
    const PlanResult exact = plan(roadmap, start, goal, {.planner = Planner::kEsdf});
    EXPECT_LE(usual.length, 1.15 * exact.length);
    sum += std::max(usual.length / exact.length, 1.0);
    ++paths;
  }
  EXPECT_GT(paths, 40);
  EXPECT_LE(sum, 1.06 * paths);
}

/// A corridor of 1.5 m that turns back four times, in a hall of 8 x 6 m.
OccupancyMap serpentine() {
  return testing::make_map(kBoundVoxel, {0, 0, 0}, {79, 59, 9}, [](const VoxelIndex& v) {
    const bool is_border = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 79 || v.y == 59 || v.z == 9;
    const bool is_open = (v.x / 16) % 2 == 0 ? v.y >= 45 : v.y < 15;
    const bool is_wall = v.x % 16 == 0 && !is_open;
    return is_border || is_wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(Within, LandmarksForetellHowLongWindingWaysAre) {
  const Roadmap roadmap = build_roadmap(serpentine(), {.min_clearance = kBoundRadius}).roadmap;
  const EsdfMap& esdf = roadmap.esdf;
  ASSERT_FALSE(roadmap.cells.lengths.empty());
  std::mt19937 random(1);
  const std::vector<VoxelId> places = testing::traversable_places(esdf, kBoundRadius);
  int winding = 0, foretold = 0;
  for (int i = 0; i < 100; ++i) {
    const VoxelId from = places[random() % places.size()], to = places[random() % places.size()];
    const auto place = [&](VoxelId id) {
      return to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
    };
    const PlanResult exact = plan(roadmap, place(from), place(to), {.planner = Planner::kEsdf});
    ASSERT_TRUE(exact.ok());
    const double expected = detail::length_between(roadmap, from, to, kBoundRadius);
    // Each end may be half a block's diagonal away from the middle of its block's cells.
    EXPECT_LE(expected, 1.05 * exact.length + std::sqrt(3.0) * kBlockSide * kBoundVoxel);
    if (exact.length < 1.5 * (place(from) - place(to)).norm()) continue;
    ++winding;
    foretold += expected > 0.8 * exact.length;
  }
  EXPECT_GT(winding, 40);
  EXPECT_GT(2 * foretold, winding);
}

TEST(Within, RefusesWhatIsNoFactor) {
  std::mt19937 random(1);
  const Roadmap roadmap = roadmap_of_boxes(random);
  for (const double bad : {-1.0, 0.5, 0.999, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(plan(roadmap, {0.5, 0.5, 0.5}, {1, 1, 1}, {.within = bad}), InputError);
}

}  // namespace
}  // namespace ridgeway
