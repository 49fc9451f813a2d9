// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Basins that follow a field are those of the field, whatever their numbers.
#include "live/live_basins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/random_changes.hpp"

namespace ridgeway {
namespace {

TEST(LiveBasins, AfterRandomChangesAreThoseOfTheField) {
  std::size_t members = 0, gone = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    detail::LiveField field(0.1, {}, {.max_distance = seed % 2 == 0 ? 0.8 : 3.0});
    detail::LiveRidges ridges = {.radius = 0.05 + 0.05 * (seed % 3)};
    detail::LiveBasins basins;
    BasinNumbers numbers;
    std::vector<VoxelId> before;
    for (int step = 0; step < 30; ++step) {
      SCOPED_TRACE(step);
      apply_changes(field, testing::random_changes(random, {-34, -20, -22}, {30, 34, 20}));
      update_distances(field);
      update_traversable(ridges, field);
      update_basins(basins, numbers, field, ridges);
      const detail::Watershed live =
          watershed_of(basins, numbers, basins.ways.next, field, ridges.traversable);
      detail::Watershed fresh = detail::find_watershed(field.esdf, ridges.traversable);
      std::erase_if(fresh.critical, [&](const detail::CriticalVoxel& voxel) {
        return detail::higher_in_others(field.esdf.layout, fresh.basins.basin, voxel) == 0;
      });
      ASSERT_EQ(live.critical, fresh.critical);
      ASSERT_EQ(live.basins.not_simple_at_first_turn, fresh.basins.not_simple_at_first_turn);
      ASSERT_EQ(live.basins.next.values(), fresh.basins.next.values());
      for (const VoxelId id : ridges.traversable.members(field.esdf.layout))
        ASSERT_EQ(live.basins.peaks[live.basins.basin[id]],
                  fresh.basins.peaks[fresh.basins.basin[id]]);
      std::vector<VoxelId> peaks = live.basins.peaks, expected = fresh.basins.peaks;
      std::erase(peaks, kNoVoxel);
      std::sort(peaks.begin(), peaks.end());
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(peaks, expected);
      std::erase_if(before,
                    [&](VoxelId id) { return std::binary_search(peaks.begin(), peaks.end(), id); });
      gone += before.size();
      members += peaks.size();
      before = std::move(peaks);
    }
  }
  EXPECT_GT(members, 10000u);
  EXPECT_GT(gone, 80u);
}

}  // namespace
}  // namespace ridgeway
