// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <random>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"
#include "support/places.hpp"

namespace ridgeway {
namespace {

using testing::kPillarClearance;

/// Among the same pillars with and without a tangent graph.
struct Hall {
  Roadmap with, without;
  std::vector<VoxelId> places;

  explicit Hall(unsigned seed) {
    std::vector<Eigen::Vector2d> axes;
    const OccupancyMap map = testing::pillars(seed, axes);
    BuildConfig config;
    config.min_clearance = kPillarClearance;
    with = build_roadmap(map, config).roadmap;
    config.tangent_pairs = 0;
    without = build_roadmap(map, config).roadmap;
    places = testing::traversable_places(with.esdf, kPillarClearance);
  }

  Point place(std::mt19937& random) const {
    const VoxelId id = places[random() % places.size()];
    return centre_of(with.esdf.layout.index_of(id), with.esdf.voxel_size);
  }
};

TEST(TangentPath, IsVerifiedAndAboutAsShortAsAFullSearch) {
  int bent = 0, by_corners = 0;
  double sum = 0.0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Hall hall(seed);
    const FreeSpace space(hall.with.esdf);
    std::mt19937 random(seed);
    for (int i = 0; i < 30; ++i) {
      const Point start = hall.place(random), goal = hall.place(random);
      const PlanResult full = plan(hall.without, start, goal);
      const PlanResult path = plan(hall.with, start, goal);
      ASSERT_EQ(path.status, full.status);
      if (!path.ok() || path.waypoints.size() == 2) continue;
      ++bent;
      by_corners += path.seconds.attach == 0.0 ? 1 : 0;  // the sparse graph was not asked
      EXPECT_EQ(path.waypoints.front(), start);
      EXPECT_EQ(path.waypoints.back(), goal);
      EXPECT_NEAR(path.clearance, space.clearance(path.waypoints), 1e-12);
      EXPECT_GE(path.clearance, kPillarClearance * (1.0 - 1e-9));
      EXPECT_LE(path.length, 1.1 * full.length);
      sum += path.length / full.length;
    }
  }
  EXPECT_GT(bent, 360);
  EXPECT_GT(by_corners, bent / 2);
  EXPECT_LE(sum / bent, 1.005);
}

TEST(TangentPath, QuickPathsHoldAndAreHardlyLongerWithCornersAndWithout) {
  int found = 0;
  double sum = 0.0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const Hall hall(seed);
    std::mt19937 random(seed);
    for (int i = 0; i < 20; ++i) {
      const Point start = hall.place(random), goal = hall.place(random);
      const PlanResult usual = plan(hall.without, start, goal);
      for (const Roadmap* roadmap : {&hall.with, &hall.without}) {
        const PlanResult quick = plan(*roadmap, start, goal, {.quick = true});
        ASSERT_EQ(quick.status, usual.status);
        if (!quick.ok()) continue;
        ++found;
        sum += quick.length / usual.length;
        const double clearance = FreeSpace(roadmap->esdf).clearance(quick.waypoints);
        EXPECT_NEAR(quick.clearance, clearance, 1e-12);
        EXPECT_GE(clearance, kPillarClearance * (1.0 - 1e-9));
        EXPECT_LE(quick.length, 1.5 * usual.length);
      }
    }
  }
  EXPECT_GT(found, 100);
  EXPECT_LE(sum / found, 1.02);
}

}  // namespace
}  // namespace ridgeway
