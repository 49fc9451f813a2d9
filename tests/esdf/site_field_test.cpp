// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Offsets to sites are the same in either form, and the smaller one is taken where it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "esdf/distance_sweeps.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "support/plain_sites.hpp"
#include "support/random_changes.hpp"

namespace ridgeway {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

TEST(SiteField, HoldsAnyOffsetOnceThereIsOneThatIsNotNear) {
  const BlockLayout layout(testing::blocks_of_box({0, 0, 0}, {1, 1, 0}));
  SiteField field(SiteField::Near(layout, {}));
  std::vector<SiteOffset> expected(layout.voxel_count());
  std::mt19937 random(1);
  const auto part = [&](int most) {
    return static_cast<std::int16_t>(static_cast<int>(random()) % (most + 1));
  };
  for (const int most : {NearSiteOffset::kFarthest, kFarthestSite}) {
    for (int i = 0; i < 2000; ++i) {
      const auto id = static_cast<VoxelId>(random() % layout.voxel_count());
      field.set(id, expected[id] = {part(most), part(most), part(most)});
    }
    EXPECT_EQ(field.has_near_only(), most == NearSiteOffset::kFarthest);
    EXPECT_TRUE(field.values() == expected);
    EXPECT_TRUE(field.is_of(layout));
    EXPECT_EQ(field[7], expected[7]);
  }
}

TEST(SiteField, OwnsBlocksInTheOtherFormToo) {
  const BlockLayout layout(testing::blocks_of_box({0, 0, 0}, {1, 0, 0}));
  SiteField field(SiteField::Near{});
  field.grow(layout);
  field.set(3, {NearSiteOffset::kFarthest + 1, 0, 0});
  const SiteField before = field.shared();
  field.own_block(0);
  field.set(3, {1, 2, 3});
  EXPECT_EQ(before[3], (SiteOffset{NearSiteOffset::kFarthest + 1, 0, 0}));
  EXPECT_EQ(field[3], (SiteOffset{1, 2, 3}));
}

TEST(SiteField, TakesHalfTheMemoryForNearOnes) {
  const BlockLayout layout(testing::blocks_of_box({0, 0, 0}, {9, 9, 9}));
  const SiteField near(SiteField::Near(layout, {})), any(SiteField::Any(layout, {}));
  EXPECT_LT(near.memory_bytes(), any.memory_bytes() * 51 / 100);
}

/// Sites are in the smaller form where blocks can tell that all are near, which they can up to two
/// blocks along each axis; what is not near is in the other one.
void expect_smallest_form(const detail::NearestSites& found, int axes) {
  const auto values = found.squared.values();
  const double farthest = std::sqrt(*std::max_element(values.begin(), values.end())) / 2.0;
  const double unsure = 2.0 * kBlockSide * std::sqrt(axes);
  if (farthest > NearSiteOffset::kFarthest) EXPECT_FALSE(found.offset.has_near_only());
  if (farthest < NearSiteOffset::kFarthest - unsure) EXPECT_TRUE(found.offset.has_near_only());
}

/// Obstacles here and there in a row of blocks along an axis.
class SitesAlong : public ::testing::TestWithParam<int> {};

TEST_P(SitesAlong, AxisAreExactInTheFormThatTheyAreIn) {
  const int axis = GetParam();
  std::size_t near = 0, far = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int blocks = 15 + static_cast<int>(random() % 24);
    const auto along = [&](int k) {
      return VoxelIndex{axis == 0 ? k : 0, axis == 1 ? k : 0, axis == 2 ? k : 0};
    };
    const VoxelIndex last = along(blocks - 1);
    const BlockLayout layout(testing::blocks_of_box({0, 0, 0}, {last.x, last.y, last.z}));
    VoxelMask obstacle(layout);
    std::vector<VoxelIndex> obstacles;
    for (unsigned i = 0; i < 1 + seed % 3; ++i)
      obstacle.set(static_cast<VoxelId>(random() % layout.voxel_count()));
    for (int z = 0; z < 8 * (last.z + 1); ++z)
      for (int y = 0; y < 8 * (last.y + 1); ++y)
        for (int x = 0; x < 8 * (last.x + 1); ++x)
          if (obstacle.test(layout.find({x, y, z}))) obstacles.push_back({x, y, z});
    const detail::NearestSites found =
        detail::sweep_distances(layout, obstacle, false, false, kNoLimit);
    for (VoxelId id = 0; id < layout.voxel_count(); ++id)
      ASSERT_TRUE(testing::has_plain_site(layout, found, id, obstacles));
    expect_smallest_form(found, 1);
    (found.offset.has_near_only() ? near : far) += 1;
  }
  EXPECT_GT(near, 10u);
  EXPECT_GT(far, 10u);
}

TEST_P(SitesAlong, AxisAreExactAsFarAsIsAskedFor) {
  const VoxelIndex last{GetParam() == 0 ? 39 : 0, GetParam() == 1 ? 39 : 0,
                        GetParam() == 2 ? 39 : 0};
  const BlockLayout layout(testing::blocks_of_box({0, 0, 0}, {last.x, last.y, last.z}));
  VoxelMask obstacle(layout);
  obstacle.set(layout.find({3, 2, 1}));
  const auto near =
      detail::sweep_distances(layout, obstacle, false, false, NearSiteOffset::kFarthest);
  const auto any = detail::sweep_distances(layout, obstacle, false, false, kNoLimit);
  ASSERT_TRUE(near.offset.has_near_only());
  ASSERT_FALSE(any.offset.has_near_only());
  for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
    const bool is_asked_for =
        any.squared[id] <= 4u * NearSiteOffset::kFarthest * NearSiteOffset::kFarthest;
    ASSERT_EQ(near.squared[id] <= 4u * NearSiteOffset::kFarthest * NearSiteOffset::kFarthest,
              is_asked_for);
    if (!is_asked_for) continue;
    ASSERT_EQ(near.squared[id], any.squared[id]);
    ASSERT_EQ(near.offset[id], any.offset[id]);
  }
}

/// Distances have parts along several axes, and each part alone is near.
TEST(Sites, InABoxAreExactInTheFormThatTheyAreIn) {
  const BlockLayout layout(testing::blocks_of_box({0, 0, 0}, {13, 13, 13}));
  std::size_t near = 0, far = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    VoxelMask obstacle(layout);
    std::vector<VoxelIndex> obstacles;
    for (unsigned i = 0; i < 1 + seed / 2; ++i) {
      const auto id = static_cast<VoxelId>(random() % layout.voxel_count());
      obstacle.set(id);
      obstacles.push_back(layout.index_of(id));
    }
    std::sort(obstacles.begin(), obstacles.end());
    const auto found = detail::sweep_distances(layout, obstacle, false, false, kNoLimit);
    for (VoxelId id = 0; id < layout.voxel_count(); id += 13)
      ASSERT_TRUE(testing::has_plain_site(layout, found, id, obstacles));
    expect_smallest_form(found, 3);
    (found.offset.has_near_only() ? near : far) += 1;
  }
  EXPECT_GT(near, 2u);
  EXPECT_GT(far, 2u);
}

/// Wide layers with blocks missing here and there, which are obstacles as all that is outside.
TEST(Sites, InALayerWithGapsAreExactInTheFormThatTheyAreIn) {
  std::size_t near = 0, far = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int side = 30 + static_cast<int>(seed);
    const auto is_gap = [&] { return seed % 2 == 1 && random() % 400 == 0; };
    std::vector<BlockIndex> blocks;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (!is_gap()) blocks.push_back({x, y, 0});
    const BlockLayout layout(blocks);
    const auto found = detail::sweep_distances(layout, VoxelMask(layout), true, true, kNoLimit);
    std::vector<VoxelIndex> obstacles;
    for (int y = -1; y <= 8 * side; ++y)
      for (int x = -1; x <= 8 * side; ++x)
        if (const VoxelIndex v{x, y, kPlanarLayer}; layout.find(v) == kNoVoxel)
          obstacles.push_back(v);
    for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
      const bool is_asked = layout.index_of(id).z == kPlanarLayer && random() % 300 == 0;
      if (is_asked) ASSERT_TRUE(testing::has_plain_site(layout, found, id, obstacles));
    }
    expect_smallest_form(found, 2);
    (found.offset.has_near_only() ? near : far) += 1;
  }
  EXPECT_GT(near, 2u);
  EXPECT_GT(far, 2u);
}

INSTANTIATE_TEST_SUITE_P(Each, SitesAlong, ::testing::Values(0, 1, 2));

}  // namespace
}  // namespace ridgeway
