// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/shell_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "random_levels.hpp"
#include "ridgeway/skeleton/diagram.hpp"

namespace ridgeway {
namespace {

/// Opens shells of random sets again and again, each time with a few voxels that are others.
class ChangingShells {
 public:
  explicit ChangingShells(unsigned seed)
      : random_(seed), levels_(testing::random_levels(seed)), keep_(levels_.esdf.layout) {}

  /// Takes voxels out and in, keeps others, gives levels; `changed`: where.
  void change(VoxelMask& changed) {
    for (unsigned i = 1 + below(12); i > 0; --i) {
      const VoxelId id = below(static_cast<unsigned>(esdf().layout.voxel_count()));
      flip(voxels(), id);
      if (below(3) == 0) flip(keep_, below(static_cast<unsigned>(esdf().layout.voxel_count())));
    }
    for (unsigned i = below(12); i > 0; --i) {
      const VoxelId id = below(static_cast<unsigned>(esdf().layout.voxel_count()));
      levels_.esdf.squared[id] = 1 + below(60);
      changed.set(id);
    }
    for (const VoxelId id : keep_.members(esdf().layout))
      if (!voxels().test(id)) keep_.reset(id);
    for (const VoxelId id : voxels().members(esdf().layout))
      if (levels_.esdf.squared[id] == 0) voxels().reset(id), keep_.reset(id);
  }
  const EsdfMap& esdf() const { return levels_.esdf; }
  VoxelMask& voxels() { return levels_.traversable; }
  const VoxelMask& keep() const { return keep_; }

 private:
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }
  static void flip(VoxelMask& mask, VoxelId id) { mask.test(id) ? mask.reset(id) : mask.set(id); }

  std::mt19937 random_;
  testing::RandomLevels levels_;
  VoxelMask keep_;
};

TEST(ShellMemory, AfterAnyChangesHasWhatOpeningAllLeaves) {
  std::size_t left = 0, opened = 0, others = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    ChangingShells shells(seed);
    // Sparse sets, which fall into components, and dense ones.
    std::mt19937 random(seed);
    for (const VoxelId id : VoxelMask(shells.voxels()).members(shells.esdf().layout))
      if (random() % 10 < seed % 9) shells.voxels().reset(id);
    detail::ShellMemory memory;
    VoxelMask before(shells.esdf().layout);
    for (int step = 0; step < 12; ++step) {
      SCOPED_TRACE(step);
      VoxelMask changed(shells.esdf().layout);
      shells.change(changed);
      VoxelMask fresh = shells.voxels();
      open_shells(shells.esdf(), fresh, shells.keep());
      ASSERT_EQ(memory.open(shells.esdf(), shells.voxels(), shells.keep(), changed), fresh);
      left += fresh.count();
      opened += shells.voxels().count() - fresh.count();
      others += fresh == before ? 0u : 1u;
      before = fresh;
    }
  }
  EXPECT_GT(left, 100000u);
  EXPECT_GT(opened, 100000u);
  EXPECT_GT(others, 3000u);
}

}  // namespace
}  // namespace ridgeway
