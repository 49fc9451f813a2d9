// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/thinning_memory.hpp"

#include <gtest/gtest.h>

#include "ridgeway/skeleton/gvd.hpp"
#include "support/random_shapes.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

/// A set that comes and goes by voxels near random ones, with its memory beside it.
class ChangingSet {
 public:
  ChangingSet(const BlockLayout& layout, VoxelMask voxels)
      : layout_(layout), voxels_(std::move(voxels)), thinned_(layout) {
    tell(voxels_);
  }

  void flip_some(std::mt19937& random, unsigned reach) {
    VoxelMask changed(layout_);
    const VoxelIndex around =
        layout_.index_of(static_cast<VoxelId>(random() % layout_.voxel_count()));
    const auto step = [&] {
      return static_cast<int>(random() % (2 * reach + 1)) - static_cast<int>(reach);
    };
    for (auto i = 1 + random() % 40; i > 0; --i) {
      const int x = step(), y = step(), z = step();
      if (const VoxelId id = layout_.find(around + VoxelIndex{x, y, z}); id != kNoVoxel)
        changed.set(id);
    }
    flip(changed);
  }

  void flip(const VoxelMask& changed) {
    for (const VoxelId id : changed.members(layout_))
      voxels_.test(id) ? voxels_.reset(id) : voxels_.set(id);
    tell(changed);
  }

  const VoxelMask& thinned() const { return thinned_; }
  VoxelMask thinned_anew() const {
    VoxelMask thinned = voxels_;
    thin(layout_, thinned);
    return thinned;
  }

 private:
  void tell(const VoxelMask& changed) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t slot = 0; slot < layout_.block_count(); ++slot)
      if (!detail::is_empty(changed.block(slot))) slots.push_back(slot);
    memory_.thin(layout_, voxels_, changed, slots, thinned_);
  }

  const BlockLayout& layout_;
  VoxelMask voxels_, thinned_;
  detail::ThinningMemory memory_;
};

TEST(ThinningMemory, AfterAnyChangesHasWhatThinningLeaves) {
  std::size_t changed = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const testing::RandomShape shape = testing::random_shape(seed);
    std::mt19937 random(seed);
    ChangingSet set(shape.layout, shape.voxels);
    VoxelMask before = set.thinned();
    ASSERT_EQ(before, set.thinned_anew()) << "seed " << seed;
    for (int step = 0; step < 15; ++step) {
      set.flip_some(random, 1 + seed % 5);
      ASSERT_EQ(set.thinned(), set.thinned_anew()) << "seed " << seed << " step " << step;
      changed += set.thinned() != before;
      before = set.thinned();
    }
  }
  EXPECT_GT(changed, 1000u);
}

/// A sheet shrinks from its rim, a voxel a round: to its middle it takes more rounds than a byte
/// holds.
TEST(ThinningMemory, KnowsLateRounds) {
  constexpr int kSide = 38;  // blocks
  std::vector<BlockIndex> blocks;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) blocks.push_back({x, y, 0});
  const BlockLayout layout(blocks);
  VoxelMask sheet(layout), hole(layout), crumbs(layout);
  for (int y = 0; y < 8 * kSide; ++y)
    for (int x = 0; x < 8 * kSide; ++x) sheet.set(layout.find({x, y, 3}));
  hole.set(layout.find({4 * kSide + 20, 4 * kSide - 9, 3}));
  crumbs.set(layout.find({4 * kSide, 4 * kSide, 4}));
  ChangingSet set(layout, sheet);
  const VoxelMask whole = set.thinned();
  ASSERT_EQ(whole, set.thinned_anew());
  for (const VoxelMask& change : {crumbs, hole, crumbs, hole}) {
    set.flip(change);
    ASSERT_EQ(set.thinned(), set.thinned_anew());
  }
  EXPECT_EQ(set.thinned(), whole);
  EXPECT_LT(whole.count(), 2u * 8u * kSide + 1);
}

}  // namespace
}  // namespace ridgeway
