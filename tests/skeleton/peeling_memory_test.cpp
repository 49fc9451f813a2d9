// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/peeling_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_levels.hpp"
#include "skeleton/level_peeling.hpp"
#include "skeleton/watershed.hpp"

namespace ridgeway {
namespace {

/// Gives some voxels near a random one another level, takes them out, or in.
VoxelMask change_some(testing::RandomLevels& levels, std::mt19937& random) {
  const BlockLayout& layout = levels.esdf.layout;
  VoxelMask changed(layout);
  const VoxelIndex around = layout.index_of(static_cast<VoxelId>(random() % layout.voxel_count()));
  const auto step = [&](unsigned reach) {
    return static_cast<int>(random() % (2 * reach + 1)) - static_cast<int>(reach);
  };
  const unsigned reach = 1 + static_cast<unsigned>(random() % 4);
  for (auto i = 1 + random() % 30; i > 0; --i) {
    const VoxelId id = layout.find(around + VoxelIndex{step(reach), step(reach), step(reach)});
    if (id == kNoVoxel) continue;
    const VoxelId other = static_cast<VoxelId>(random() % layout.voxel_count());
    const bool is_in = levels.traversable.test(other);
    levels.esdf.squared[id] = is_in ? levels.esdf.squared[other] : 0;
    if (is_in)
      levels.traversable.set(id);
    else
      levels.traversable.reset(id);
    changed.set(id);
  }
  return changed;
}

TEST(PeelingMemory, AfterAnyChangesHasWhatPeelingLeaves) {
  std::size_t left = 0, came = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    testing::RandomLevels levels = testing::random_levels(seed);
    const BlockLayout& layout = levels.esdf.layout;
    std::mt19937 random(seed);
    VoxelMask keep(layout), changed(layout);
    std::vector<std::uint32_t> slots(layout.block_count());
    for (std::uint32_t slot = 0; slot < slots.size(); ++slot) slots[slot] = slot;
    detail::PeelingMemory memory;
    VoxelMask before(layout);
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE(step);
      memory.change(layout, changed, slots);
      for (auto i = random() % 3; i > 0; --i) {
        const VoxelId id = static_cast<VoxelId>(random() % layout.voxel_count());
        if (!keep.test(id) && levels.traversable.test(id)) keep.set(id);
      }
      for (const VoxelId id : keep.members(layout))
        if (!levels.traversable.test(id) || random() % 10 == 0) keep.reset(id);
      const detail::Watershed watershed = detail::find_watershed(levels.esdf, levels.traversable);
      const VoxelMask& not_simple = watershed.basins.not_simple_at_first_turn;
      const VoxelMask fresh =
          detail::peel_levels(levels.esdf, levels.traversable, not_simple, keep);
      EsdfMap now;  // of its own, as its levels are kept
      now.layout = layout;
      now.squared = VoxelField<std::uint32_t>(levels.esdf.squared);
      ASSERT_EQ(memory.peel(now, levels.traversable, not_simple, keep), fresh);
      left += fresh.count();
      came += fresh == before ? 0u : 1u;
      before = fresh;
      changed = change_some(levels, random);
    }
  }
  EXPECT_GT(left, 100000u);
  EXPECT_GT(came, 1000u);
}

}  // namespace
}  // namespace ridgeway
