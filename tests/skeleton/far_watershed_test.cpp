// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/watershed.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// Far out floats round what distances differ by: 4 d^2 is above 2^24 from 2,048 voxels on. Which
/// way climbs most steeply hangs on differences alone, so it stays as it is where all lies higher.
TEST(Watershed, IsTheSameHoweverFarFromObstaclesItLies) {
  constexpr std::uint32_t kHigher = 1'000'000'001;  // 4 d^2 at 15,811 voxels
  std::size_t voxels = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    EsdfMap esdf = compute_esdf(testing::random_map(seed, 30));
    const VoxelMask traversable = traversable_voxels(esdf, 0.05);
    const detail::Watershed near = detail::find_watershed(esdf, traversable);
    const std::vector<VoxelId> members = traversable.members(esdf.layout);
    for (const VoxelId id : members) esdf.squared[id] += kHigher;
    const detail::Watershed far = detail::find_watershed(esdf, traversable);
    EXPECT_EQ(near.critical, far.critical);
    EXPECT_EQ(near.basins.peaks, far.basins.peaks);
    EXPECT_EQ(near.basins.not_simple_at_first_turn, far.basins.not_simple_at_first_turn);
    std::size_t other = 0;
    for (const VoxelId id : members) other += near.basins.next[id] != far.basins.next[id];
    EXPECT_EQ(other, 0u);
    voxels += members.size();
  }
  EXPECT_GT(voxels, 50000u);
}

}  // namespace
}  // namespace ridgeway
