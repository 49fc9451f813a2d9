// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/block_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "ridgeway/common/error.hpp"
#include "ridgeway/voxel/voxel_field.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {
namespace {

constexpr int kFarthestBlock = BlockLayout::kFarthestBlock;

struct RandomLayout {
  std::set<BlockIndex> blocks;
  BlockLayout layout;

  explicit RandomLayout(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> near(-3, 3);
    std::vector<BlockIndex> list;
    list.reserve(61);
    for (int i = 0; i < 60; ++i) list.push_back({near(random), near(random), near(random)});
    if (seed % 2 == 0)
      list.push_back({-kFarthestBlock, kFarthestBlock, 5});  // else they fill their box
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

TEST(BlockLayout, RefusesBlocksBeyondTheCoordinateLimitAndStaysAsItWas) {
  EXPECT_THROW(BlockLayout({{268435456, 0, 0}}), InputError);  // whose voxels would overflow
  BlockLayout layout({{0, 0, 0}});
  const BlockLayout before = layout;
  for (const auto axis : {&BlockIndex::x, &BlockIndex::y, &BlockIndex::z})
    for (const int sign : {-1, 1}) {
      BlockIndex block{1, 2, 3};
      block.*axis = sign * kFarthestBlock;
      const BlockLayout farthest({block});
      EXPECT_EQ(farthest.find(farthest.index_of(511)), 511u);
      EXPECT_EQ(farthest.neighbour(0, 0), kNoVoxel);
      block.*axis += sign;
      EXPECT_THROW(BlockLayout({block}), InputError);
      EXPECT_THROW(layout.add(std::vector{BlockIndex{1, 0, 0}, block}), InputError);
      EXPECT_TRUE(layout == before);
      EXPECT_EQ(layout.stamp(), before.stamp());
      EXPECT_EQ(layout.find_block({1, 0, 0}), BlockLayout::kNoBlock);
    }
}

/// Blocks in a random order, and in how many steps they come.
struct Growth {
  std::vector<BlockIndex> blocks;  // with doubles
  std::vector<std::size_t> steps;  // how many at once

  explicit Growth(unsigned seed) {
    const RandomLayout whole(seed);
    blocks.assign(whole.blocks.begin(), whole.blocks.end());
    blocks.insert(blocks.end(), whole.blocks.begin(), whole.blocks.end());
    std::mt19937 random(seed);
    std::shuffle(blocks.begin(), blocks.end(), random);
    for (std::size_t left = blocks.size(); left > 0; left -= steps.back())
      steps.push_back(std::min<std::size_t>(left, 1 + random() % 20));
  }
};

TEST(BlockLayout, KeepsItsSlotsAndKnowsItsOrderAsBlocksAreAdded) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Growth growth(seed);
    BlockLayout layout;
    std::set<BlockIndex> added;
    std::size_t first = 0;
    for (const std::size_t step : growth.steps) {
      const std::vector<BlockIndex> before(layout.blocks().begin(), layout.blocks().end());
      const auto more = std::span(growth.blocks).subspan(first, step);
      layout.add(more);
      first += step;
      added.insert(more.begin(), more.end());
      ASSERT_EQ(layout.block_count(), added.size());
      ASSERT_TRUE(std::equal(before.begin(), before.end(), layout.blocks().begin()));
      const BlockLayout at_once({added.begin(), added.end()});
      for (std::uint32_t order = 0; order < layout.voxel_count(); order += 37) {
        const VoxelId id = layout.voxel_at_order(order);
        ASSERT_EQ(layout.order_of(id), order);
        ASSERT_EQ(layout.index_of(id), at_once.index_of(order));
        ASSERT_EQ(layout.find(at_once.index_of(order)), id);
        for (int d = 0; d < 27; ++d) {
          const VoxelId a = layout.neighbour(id, d), b = at_once.neighbour(order, d);
          ASSERT_EQ(a == kNoVoxel ? kNoVoxel : layout.order_of(a), b);
        }
      }
      ASSERT_EQ(layout.is_in_order(),
                std::is_sorted(layout.blocks().begin(), layout.blocks().end()));
    }
  }
}

TEST(BlockLayout, BlocksAddedInOrderLeaveItInOrder) {
  const RandomLayout random(3);
  BlockLayout layout;
  for (const BlockIndex& block : random.blocks) layout.add(std::span(&block, 1));
  EXPECT_TRUE(layout.is_in_order());
  EXPECT_TRUE(layout == random.layout);
  EXPECT_EQ(layout.stamp(), random.layout.stamp());
}

TEST(VoxelField, SharesBlocksUntilTheyAreOwned) {
  BlockLayout layout = RandomLayout(7).layout;
  VoxelField<int> field(layout, 5);
  const VoxelField<int> copy = field;
  layout.add(std::vector<BlockIndex>{{500, 0, 0}});
  field.grow(layout, 6);
  const VoxelField<int> shared = field.shared();
  EXPECT_NE(copy.block(0), field.block(0));
  EXPECT_TRUE(shared.is_of(layout));
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    EXPECT_EQ(shared.block(slot), field.block(slot));
  field.own_block(1);
  field[kBlockVoxels + 3] = 9;
  EXPECT_NE(shared.block(1), field.block(1));
  EXPECT_EQ(shared.block(2), field.block(2));
  EXPECT_EQ(shared[kBlockVoxels + 3], 5);
  EXPECT_EQ(field[kBlockVoxels + 3], 9);
  EXPECT_EQ(field[kBlockVoxels + 2], 5);
  EXPECT_EQ(field[static_cast<VoxelId>(layout.voxel_count() - 1)], 6);
  VoxelField<int> other = shared;  // a copy is one of its own
  other[0] = 1;
  EXPECT_EQ(shared[0], 5);
  EXPECT_TRUE(shared.values() == VoxelField<int>(shared).values());
}

TEST(VoxelField, TakesTheMemoryOfAnotherAndKeepsIt) {
  BlockLayout layout = RandomLayout(7).layout;
  const std::uint32_t before = layout.block_count();
  auto whole = std::make_unique<VoxelField<int>>(layout, 5);  // in one piece
  VoxelField<int> field = whole->shared();
  layout.add(std::vector<BlockIndex>{{500, 0, 0}});
  auto grown = std::make_unique<VoxelField<int>>(layout, 7);
  grown->grow(layout);
  grown->own_block(2);
  (*grown)[2 * kBlockVoxels] = 8;
  field.follow(*grown);
  EXPECT_TRUE(field.is_of(layout));
  EXPECT_EQ(field.block(1), whole->block(1));
  EXPECT_EQ(field.block(before), grown->block(before));
  field.share_block(*grown, 1);
  field.share_block(*grown, 2);
  whole.reset();
  grown.reset();
  EXPECT_EQ(field[0], 5);
  EXPECT_EQ(field[kBlockVoxels], 7);
  EXPECT_EQ(field[2 * kBlockVoxels], 8);
  EXPECT_EQ(field[before * kBlockVoxels], 7);
}

TEST(BlockLayout, FieldsGrowWithItAndKeepTheirValues) {
  const Growth growth(5);
  BlockLayout layout;
  VoxelField<int> field(layout);
  VoxelMask mask(layout);
  std::size_t first = 0;
  for (const std::size_t step : growth.steps) {
    const BlockLayout before = layout;
    layout.add(std::span(growth.blocks).subspan(first, step));
    first += step;
    if (!(layout == before)) {
      ASSERT_FALSE(field.is_of(layout));
      ASSERT_FALSE(mask.is_of(layout));
    }
    field.grow(layout, -1);
    mask.grow(layout);
    ASSERT_TRUE(field.is_of(layout) && mask.is_of(layout));
    for (VoxelId id = 0; id < layout.voxel_count(); ++id) {
      const bool is_old = id < before.voxel_count();
      ASSERT_EQ(field[id], is_old ? static_cast<int>(id) : -1);
      ASSERT_EQ(mask.test(id), is_old && id % 3 == 0);
      field[id] = static_cast<int>(id);
      if (id % 3 == 0) mask.set(id);
    }
  }
  std::vector<VoxelIndex> members;
  for (const VoxelId id : mask.members(layout)) members.push_back(layout.index_of(id));
  const auto in_order = [](const VoxelIndex& a, const VoxelIndex& b) {
    return std::pair(block_of(a), a) < std::pair(block_of(b), b);
  };
  EXPECT_TRUE(std::is_sorted(members.begin(), members.end(), in_order));
  EXPECT_EQ(members.size(), mask.count());
}

TEST(BlockLayout, FieldsOfAnotherLayoutAreAnErrorInDebugBuilds) {
  const BlockLayout one({{0, 0, 0}, {1, 0, 0}}), other({{0, 0, 0}, {2, 0, 0}});
  BlockLayout turned;
  turned.add(std::vector{BlockIndex{1, 0, 0}, BlockIndex{0, 0, 0}});
  const VoxelMask mask(one);
  EXPECT_TRUE(mask.is_of(BlockLayout({{1, 0, 0}, {0, 0, 0}})));  // the same blocks and slots
  EXPECT_FALSE(mask.is_of(other));
  EXPECT_FALSE(mask.is_of(turned));
  EXPECT_DEBUG_DEATH(mask.members(other), "is_of");
  EXPECT_DEBUG_DEATH(cube_around(turned, mask, 0), "is_of");
  EXPECT_DEBUG_DEATH(VoxelMask(mask).grow(other), "stamp");
  EXPECT_DEBUG_DEATH(VoxelField<int>(one).grow(other), "stamp");
}

TEST(BlockLayout, EmptyHoldsNothing) {
  const BlockLayout empty;
  EXPECT_EQ(empty.find({0, 0, 0}), kNoVoxel);
  EXPECT_EQ(BlockLayout(std::vector<BlockIndex>{}).find({0, 0, 0}), kNoVoxel);
  EXPECT_EQ(VoxelFinder(empty).find({0, 0, 0}), kNoVoxel);
  EXPECT_EQ(VoxelField<int>(empty).size(), 0u);
}

TEST(BlockLayout, IsEmptyOnceItIsMovedFrom) {
  for (const int apart : {1, 1'000'000}) {  // in one box, and spread
    BlockLayout layout({{0, 0, 0}, {apart, 0, 0}, {0, apart, 0}});
    const BlockLayout moved = std::move(layout);
    EXPECT_EQ(moved.block_count(), 3u);
    EXPECT_NE(moved.find({8 * apart, 0, 0}), kNoVoxel);
    EXPECT_EQ(layout.block_count(), 0u);  // NOLINT(bugprone-use-after-move): what is asked
    EXPECT_EQ(layout.find({0, 0, 0}), kNoVoxel);
    EXPECT_TRUE(layout == BlockLayout{});
    EXPECT_TRUE(VoxelField<int>(layout).is_of(BlockLayout{}));
    layout.add(std::vector<BlockIndex>{{5, 5, 5}});
    EXPECT_EQ(layout.find({40, 40, 40}), 0u);
  }
}

}  // namespace
}  // namespace ridgeway
