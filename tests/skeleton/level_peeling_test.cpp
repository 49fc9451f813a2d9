// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/level_peeling.hpp"

#include <gtest/gtest.h>

#include <random>

#include "random_levels.hpp"
#include "ridgeway/common/parallel.hpp"
#include "skeleton/plain_peeling.hpp"
#include "skeleton/watershed.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

TEST(LevelPeeling, LeavesWhatPeelingInOrderLeavesWhateverTheLevels) {
  std::size_t left = 0, gone = 0, kept = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const testing::RandomLevels levels = testing::random_levels(seed);
    std::mt19937 random(seed);
    VoxelMask keep(levels.esdf.layout);
    for (VoxelId id = 0; id < levels.esdf.layout.voxel_count(); ++id)
      if (levels.traversable.test(id) && random() % 200 < seed % 5) keep.set(id);
    const detail::Watershed watershed = detail::find_watershed(levels.esdf, levels.traversable);
    const VoxelMask plain = detail::peel_in_order(levels.esdf, levels.traversable, keep);
    ASSERT_EQ(detail::peel_levels(levels.esdf, levels.traversable,
                                  watershed.basins.not_simple_at_first_turn, keep),
              plain);
    left += plain.count();
    gone += levels.traversable.count() - plain.count();
    kept += keep.count();
  }
  EXPECT_GT(left, 10000u);
  EXPECT_GT(gone, 100000u);
  EXPECT_GT(kept, 1000u);
}

TEST(LevelPeeling, LeavesThatAlsoWhereManyVoxelsHaveOneTurn) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const OccupancyMap map = testing::make_map(1.0, {0, 0, 0}, {47, 47, 15},
                                               [](VoxelIndex) { return VoxelState::kFree; });
    EsdfMap esdf;
    esdf.voxel_size = 1.0;
    esdf.layout = map.layout;
    esdf.squared = VoxelField<std::uint32_t>(esdf.layout, 0);
    VoxelMask traversable(esdf.layout);
    const VoxelMask keep(esdf.layout);
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
      if (random() % 10 == 0) continue;
      traversable.set(id);
      esdf.squared[id] = 1 + static_cast<std::uint32_t>(random()) % (1 + seed);
    }
    const VoxelMask not_simple =
        detail::find_watershed(esdf, traversable).basins.not_simple_at_first_turn;
    const VoxelMask plain = detail::peel_in_order(esdf, traversable, keep);
    ASSERT_GT(traversable.count() - plain.count(), 5000u);
    for (const int threads : {1, 2})
      ASSERT_EQ(
          with_threads(threads,
                       [&] { return detail::peel_levels(esdf, traversable, not_simple, keep); }),
          plain);
  }
}

}  // namespace
}  // namespace ridgeway
