// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/flood.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// Three rooms in a row, of 3, 2 and 1 m along x: a gap of 0.5 m in the first wall, and in the
/// second a hole 0.3 m wide in space that nobody has seen but for that.
OccupancyMap three_rooms() {
  return testing::make_map(0.1, {0, 0, 0}, {64, 21, 21}, [](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 64 || v.y == 21 || v.z == 21;
    if (hull) return VoxelState::kOccupied;
    if (v.x == 31) return v.y >= 8 && v.y < 13 ? VoxelState::kFree : VoxelState::kOccupied;
    const bool hole = v.y >= 9 && v.y < 12 && v.z >= 8 && v.z < 12;
    if (v.x == 52) return hole ? VoxelState::kFree : VoxelState::kUnknown;
    return VoxelState::kFree;
  });
}

TEST(PlaceFacts, TellWhatIsInTheWayToTheOtherComponents) {
  const Roadmap roadmap = build_roadmap(three_rooms(), {.min_clearance = 0.3}).roadmap;
  const PlaceFacts first = describe_place(roadmap, Point(1.5, 1, 1));
  ASSERT_EQ(first.status, PlanStatus::kOk);
  EXPECT_EQ(first.state, VoxelState::kFree);
  EXPECT_EQ(first.component, 0u);
  EXPECT_NEAR(first.clearance, 0.9, 1e-9);
  ASSERT_EQ(first.report.components.size(), 3u);
  ASSERT_EQ(first.ways.size(), 2u);
  EXPECT_EQ(first.ways[0].b, 1u);
  EXPECT_NEAR(first.ways[0].radius, 0.25, 1e-9);
  EXPECT_EQ(first.ways[0].by, Blocker::kObstacle);
  EXPECT_NEAR(first.ways[0].place.x(), 3.15, 0.2);
  EXPECT_EQ(first.ways[1].b, 2u);
  EXPECT_NEAR(first.ways[1].radius, 0.15, 1e-9);
  EXPECT_EQ(first.ways[1].by, Blocker::kUnknown);
  EXPECT_NEAR(first.ways[1].place.x(), 5.25, 0.2);
  const PlaceFacts last = describe_place(roadmap, Point(5.85, 1, 1));
  EXPECT_EQ(last.component, 2u);
  for (const ComponentJoin& way : last.ways) EXPECT_EQ(way.by, Blocker::kUnknown);
  EXPECT_EQ(describe_place(roadmap, Point(1, 1, 0.15)).status, PlanStatus::kStartInCollision);
  EXPECT_EQ(describe_place(roadmap, Point(0.05, 1, 1)).state, VoxelState::kOccupied);
  EXPECT_EQ(describe_place(roadmap, Point(90, 1, 1)).status, PlanStatus::kStartOutsideMap);
  EXPECT_THROW(describe_place(roadmap, Point(std::nan(""), 1, 1)), InputError);
}

TEST(PlaceFacts, TheSmallestSnapDoesAndALittleLessDoesNot) {
  const Roadmap roadmap = build_roadmap(three_rooms(), {.min_clearance = 0.3}).roadmap;
  const Point free(1.5, 1, 1), wall(3.14, 0.3, 1), hull(0.02, 1, 1), other(4.5, 1, 1);
  EXPECT_EQ(smallest_snap(roadmap, free, Point(1, 1, 1), 5.0), 0.0);
  EXPECT_FALSE(smallest_snap(roadmap, free, other, 0.5).has_value());
  EXPECT_FALSE(smallest_snap(roadmap, wall, free, 0.3).has_value());
  for (const double farthest : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(smallest_snap(roadmap, wall, free, farthest), InputError);
  for (const auto& [start, goal] : {std::pair(wall, free),
                                    {free, wall},
                                    {hull, wall},
                                    {wall, hull},
                                    {wall, other},
                                    {other, wall}}) {
    const std::optional<double> snap = smallest_snap(roadmap, start, goal, 5.0);
    ASSERT_TRUE(snap.has_value());
    EXPECT_GT(*snap, 0.3);
    EXPECT_LT(*snap, 0.6);
    EXPECT_TRUE(plan(roadmap, start, goal, {.snap = *snap}).ok());
    EXPECT_FALSE(plan(roadmap, start, goal, {.snap = *snap - 1e-6}).ok());
  }
}

TEST(PlaceFacts, TheirWaysAreTheWidestByFlooding) {
  int ways = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    Roadmap roadmap;
    try {
      roadmap =
          build_roadmap(testing::random_map(seed, 20), {.min_clearance = 0.15, .tangent_pairs = 0})
              .roadmap;
    } catch (const InputError&) {
      continue;
    }
    const EsdfMap& esdf = roadmap.esdf;
    const testing::Regions regions = testing::regions_at(esdf, 0.15);
    std::mt19937 random(seed);
    for (int i = 0; i < 3; ++i) {
      const VoxelId id = regions.voxels[random() % regions.voxels.size()];
      const PlaceFacts facts =
          describe_place(roadmap, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
      ASSERT_EQ(facts.status, PlanStatus::kOk);
      for (const ComponentJoin& way : facts.ways) {
        ++ways;
        const VoxelId other =
            esdf.layout.find(voxel_at(facts.report.components[way.b].widest, esdf.voxel_size));
        const auto joined_at = [&](double radius) {
          const testing::Regions at = testing::regions_at(esdf, radius);
          return at.label.contains(id) && at.label.contains(other) &&
                 at.label.at(id) == at.label.at(other);
        };
        EXPECT_TRUE(joined_at(way.radius * (1 - 1e-6)));
        EXPECT_FALSE(joined_at(way.radius * (1 + 1e-6) + 1e-9));
      }
    }
  }
  EXPECT_GT(ways, 20);
}

}  // namespace
}  // namespace ridgeway
