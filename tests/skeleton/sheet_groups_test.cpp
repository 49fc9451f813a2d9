// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/sheet_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "random_levels.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "skeleton/plain_sheet_groups.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// Few members, which hang together in threads, and many; few that come and go at a time, and many.
TEST(SheetGroups, HaveTheNearestVoxelsOfFloodsAfterAnyChanges) {
  std::size_t cuts = 0, merges = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const testing::RandomLevels levels = testing::random_levels(seed);
    const BlockLayout& layout = levels.esdf.layout;
    std::mt19937 random(seed);
    VoxelMask sheet(layout), fresh(layout), members(layout);
    detail::SheetGroups groups(levels.esdf, sheet, fresh);
    const unsigned share = 1 + seed % 7, at_once = seed % 3 == 0 ? 200 : 3;
    std::size_t before = 0;
    for (int step = 0; step < 60; ++step) {
      std::vector<VoxelId> gone, come;
      for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
        const bool is_first = step == 0 && random() % 10 < share;
        const bool changes = step > 0 && random() % layout.voxel_count() < at_once;
        if (!is_first && !changes) continue;
        (members.test(id) ? gone : come).push_back(id);
        members.test(id) ? members.reset(id) : members.set(id);
      }
      groups.update(gone, come);
      ASSERT_EQ(sheet, members);
      ASSERT_EQ(fresh.count(), 0u);
      std::vector<VoxelId> nearest = groups.nearest();
      std::vector<VoxelId> flooded = detail::nearest_of_groups(levels.esdf, members);
      std::sort(nearest.begin(), nearest.end());
      std::sort(flooded.begin(), flooded.end());
      ASSERT_EQ(nearest, flooded) << step;
      cuts += nearest.size() > before ? 1u : 0u;
      merges += nearest.size() < before ? 1u : 0u;
      before = nearest.size();
    }
    groups.update(members.members(layout), {});
    EXPECT_TRUE(groups.empty());
    EXPECT_EQ(sheet.count(), 0u);
  }
  EXPECT_GT(cuts, 500u);
  EXPECT_GT(merges, 500u);
}

/// As many shells hang together as there are specks: some minutes where each that is opened costs a
/// look at all of them.
TEST(SheetGroups, ABoxOfSpecksHasOneConnectedGraph) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {79, 79, 79}, [](const VoxelIndex& v) {
    return v.x % 2 == 1 && v.y % 2 == 1 && v.z % 2 == 1 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const BuildReport report = build_roadmap(map, {.min_clearance = 0.05, .tangent_pairs = 0}).report;
  EXPECT_EQ(report.traversable_components, 1u);
  EXPECT_EQ(report.graph_components, 1u);
}

}  // namespace
}  // namespace ridgeway
