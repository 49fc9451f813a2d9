// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/voxel_mask.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "voxel/cube_gather.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

BlockLayout holed_layout() {
  std::vector<BlockIndex> blocks;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if ((x + 2 * y + 3 * z) % 5 != 0) blocks.push_back({x, y, z});
  return BlockLayout(std::move(blocks));
}

TEST(VoxelMask, IsTheSetOfTheVoxelsThatWereSet) {
  const BlockLayout layout = holed_layout();
  VoxelMask mask(layout);
  std::set<VoxelId> set;
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    const auto id = static_cast<VoxelId>(random() % layout.voxel_count());
    if (random() % 3 == 0) {
      mask.reset(id);
      set.erase(id);
    } else {
      mask.set(id);
      set.insert(id);
    }
  }
  EXPECT_EQ(mask.count(), set.size());
  const std::vector<VoxelId> members = mask.members(layout);
  EXPECT_TRUE(std::equal(members.begin(), members.end(), set.begin(), set.end()));
  std::vector<VoxelId> by_block;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    for_each_member(mask, slot, [&](VoxelId id) { by_block.push_back(id); });
  EXPECT_EQ(by_block, members);
}

TEST(VoxelMask, BothWaysToReadACubeSeeEveryNeighbour) {
  const BlockLayout layout = holed_layout();
  for (const unsigned fill : {2u, 8u}) {
    VoxelMask mask(layout);
    std::mt19937 random(fill);
    for (VoxelId id = 0; id < layout.voxel_count(); ++id)
      if (random() % fill == 0) mask.set(id);
    for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
      const CubeGather gather(layout, mask, slot);
      for (VoxelId id = slot * kBlockVoxels; id < (slot + 1) * kBlockVoxels; ++id) {
        Cube27 expected = 0;
        for (int d = 0; d < 27; ++d) {
          const VoxelId n = layout.find(layout.index_of(id) + offset_of(d));
          if (n != kNoVoxel && mask.test(n)) expected |= 1u << d;
        }
        ASSERT_EQ(cube_around(layout, mask, id), expected);
        ASSERT_EQ(gather.cube(id), expected);
      }
    }
  }
}

/// Cells of `within` reached from `seed` by steps no longer than `longest` (squared).
Cube27 slow_flood(Cube27 seed, Cube27 within, int longest) {
  seed &= within;
  for (bool grew = true; grew;) {
    grew = false;
    for (int a = 0; a < 27; ++a)
      for (int b = 0; b < 27; ++b) {
        const VoxelIndex o = offset_of(a) - offset_of(b);
        const bool touch = o.x * o.x + o.y * o.y + o.z * o.z <= longest && std::abs(o.x) <= 1 &&
                           std::abs(o.y) <= 1 && std::abs(o.z) <= 1;
        if (!touch || !(seed >> a & 1) || !(within >> b & 1) || (seed >> b & 1)) continue;
        seed |= 1u << b;
        grew = true;
      }
  }
  return seed;
}

TEST(Neighbourhood, FloodsReachWhatStepsReach) {
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    const auto half = random();
    const auto within = static_cast<Cube27>(half & random() & kAllCells);  // a quarter of them
    const Cube27 seed = 1u << random() % 27;
    ASSERT_EQ(flood6(seed, within), slow_flood(seed, within, 1));
    ASSERT_EQ(flood26(seed, within), slow_flood(seed, within, 3));
  }
}

TEST(Neighbourhood, DirectionsAreOffsets) {
  for (int d = 0; d < 27; ++d) {
    EXPECT_EQ(direction_of(offset_of(d)), d);
    EXPECT_EQ(offset_of(d) + offset_of(opposite(d)), VoxelIndex{});
  }
  EXPECT_EQ(std::popcount(kCells6), 6);
  EXPECT_EQ(std::popcount(kCells18), 18);
  EXPECT_EQ(std::popcount(kCells26), 26);
}

TEST(DisjointSets, JoinWhatLabelsJoin) {
  DisjointSets sets(200);
  std::vector<int> label(201);
  for (int i = 0; i < 201; ++i) label[static_cast<std::size_t>(i)] = i;
  EXPECT_EQ(sets.add(), 200u);
  std::mt19937 random(2);
  for (int i = 0; i < 150; ++i) {
    const auto a = static_cast<std::uint32_t>(random() % 201);
    const auto b = static_cast<std::uint32_t>(random() % 201);
    const std::uint32_t joined = sets.join(a, b);
    ASSERT_EQ(joined, sets.find(a));
    const int from = label[a], to = label[b];
    for (int& l : label)
      if (l == from) l = to;
    for (std::uint32_t k = 0; k < 201; ++k)
      ASSERT_EQ(sets.find(k) == sets.find(a), label[k] == label[a]);
  }
}

}  // namespace
}  // namespace ridgeway
