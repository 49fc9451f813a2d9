// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/block_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "ridgeway/voxel/voxel_field.hpp"

namespace ridgeway {
namespace {

struct RandomLayout {
  std::set<BlockIndex> blocks;
  BlockLayout layout;

  explicit RandomLayout(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> near(-3, 3);
    std::vector<BlockIndex> list;
    list.reserve(61);
    for (int i = 0; i < 60; ++i) list.push_back({near(random), near(random), near(random)});
    if (seed % 2 == 0) list.push_back({-(1 << 27), 1 << 27, 5});  // else they fill their box
    blocks = {list.begin(), list.end()};
    layout = BlockLayout(list);  // doubles and all
  }
};

TEST(BlockLayout, HoldsTheBlocksInOrderAndFindsTheirVoxels) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const RandomLayout random(seed);
    const BlockLayout& layout = random.layout;
    ASSERT_TRUE(std::equal(layout.blocks().begin(), layout.blocks().end(), random.blocks.begin(),
                           random.blocks.end()));
    for (VoxelId id = 0; id < layout.voxel_count(); ++id)
      ASSERT_EQ(layout.find(layout.index_of(id)), id);
    for (int z = -34; z < 34; z += 3)
      for (int y = -34; y < 34; y += 3)
        for (int x = -34; x < 34; x += 3)
          ASSERT_EQ(layout.find({x, y, z}) != kNoVoxel,
                    random.blocks.contains(block_of(VoxelIndex{x, y, z})));
    constexpr int kLow = std::numeric_limits<int>::min(), kHigh = std::numeric_limits<int>::max();
    for (const BlockIndex& far :
         {BlockIndex{kLow, 0, 0}, BlockIndex{0, kHigh, 0}, BlockIndex{kHigh, kHigh, kLow}})
      ASSERT_EQ(layout.find_block(far), BlockLayout::kNoBlock);
  }
}

TEST(BlockLayout, DoesNotDependOnTheOrderOfTheBlocks) {
  const RandomLayout random(7);
  std::vector<BlockIndex> backwards(random.blocks.rbegin(), random.blocks.rend());
  EXPECT_TRUE(BlockLayout(backwards) == random.layout);
}

TEST(BlockLayout, StepsAndNeighboursAreTheVoxelsAtThoseOffsets) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const BlockLayout layout = RandomLayout(seed).layout;
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> offset(-8, 8);
    for (int i = 0; i < 20000; ++i) {
      const auto id = static_cast<VoxelId>(random() % layout.voxel_count());
      const VoxelIndex o{offset(random), offset(random), offset(random)};
      ASSERT_EQ(layout.step(id, o.x, o.y, o.z), layout.find(layout.index_of(id) + o));
      const int d = static_cast<int>(random() % 27);
      ASSERT_EQ(layout.neighbour(id, d), layout.find(layout.index_of(id) + offset_of(d)));
    }
  }
}

TEST(BlockLayout, FinderFindsWhatTheLayoutDoesInAnyOrder) {
  const BlockLayout layout = RandomLayout(3).layout;
  VoxelFinder finder(layout);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> place(-40, 40), hop(-3, 3);
  VoxelIndex v{0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    v = i % 50 == 0 ? VoxelIndex{place(random), place(random), place(random)}
                    : v + VoxelIndex{hop(random), hop(random), hop(random)};
    ASSERT_EQ(finder.find(v), layout.find(v));
  }
}

TEST(BlockLayout, EmptyHoldsNothing) {
  const BlockLayout empty;
  EXPECT_EQ(empty.find({0, 0, 0}), kNoVoxel);
  EXPECT_EQ(BlockLayout(std::vector<BlockIndex>{}).find({0, 0, 0}), kNoVoxel);
  EXPECT_EQ(VoxelFinder(empty).find({0, 0, 0}), kNoVoxel);
  EXPECT_EQ(VoxelField<int>(empty).size(), 0u);
}

}  // namespace
}  // namespace ridgeway
