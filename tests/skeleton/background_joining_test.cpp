// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <random>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/background_parts.hpp"
#include "skeleton/plain_peeling.hpp"
#include "skeleton/simple_point.hpp"
#include "support/betti.hpp"
#include "support/random_maps.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

using testing::Betti;
using testing::betti_numbers;

/// Boxes that float in a hall, some of one voxel, some hollow, and holes in the blocks around them.
OccupancyMap floating_boxes(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const VoxelIndex high{20 + below(30), 20 + below(30), 10 + below(20)};
  OccupancyMap map =
      testing::make_map(0.1, {0, 0, 0}, high, [&](const VoxelIndex&) { return VoxelState::kFree; });
  for (int i = 3 + below(20); i > 0; --i) {
    const int side = below(3) == 0 ? 1 : 1 + below(9);
    const VoxelState inside = below(2) == 0 ? VoxelState::kUnknown : VoxelState::kFree;
    const VoxelIndex from{below(high.x), below(high.y), below(high.z)};
    for (int z = from.z; z <= std::min(from.z + side, high.z); ++z)
      for (int y = from.y; y <= std::min(from.y + side, high.y); ++y)
        for (int x = from.x; x <= std::min(from.x + side, high.x); ++x) {
          const bool on_face = x == from.x || x == from.x + side || y == from.y ||
                               y == from.y + side || z == from.z || z == from.z + side;
          map.state[map.layout.find({x, y, z})] = on_face ? VoxelState::kOccupied : inside;
        }
  }
  return testing::drop_unknown_blocks(map);
}

struct Space {
  EsdfMap esdf;
  VoxelMask traversable;
  Basins basins;
};

Space space_of(const OccupancyMap& map, UnknownPolicy policy, double radius) {
  Space space;
  space.esdf = compute_esdf(map, {.unknown = policy});
  space.traversable = traversable_voxels(space.esdf, radius);
  space.basins = find_basins(space.esdf, space.traversable, radius);
  return space;
}

/// How much floats before and after.
struct Floating {
  long before = 0, after = 0;
};

Floating expect_joining_to_keep_its_word(Space space, bool peel = false) {
  const BlockLayout& layout = space.esdf.layout;
  const Betti before = betti_numbers(layout, space.traversable);
  EXPECT_EQ(detail::BackgroundParts(layout, space.traversable).is_one(), before.b2 == 0);
  VoxelMask open = space.traversable;
  join_background(space.esdf, open, space.basins.not_simple_at_first_turn);
  const Betti after = betti_numbers(layout, open);
  EXPECT_EQ(after.b0, before.b0);
  EXPECT_EQ(after.b1, before.b1);
  for (const VoxelId id : open.members(layout)) {
    EXPECT_TRUE(space.traversable.test(id));
    const Cube27 later = detail::plain_later(space.esdf, open, id);
    EXPECT_TRUE(space.basins.not_simple_at_first_turn.test(id) || is_simple(later));
  }
  if (peel) {
    const VoxelMask keep = significant_peaks(space.esdf, space.basins, open);
    EXPECT_EQ(compute_kernel(space.esdf, open, space.basins),
              detail::peel_in_order(space.esdf, open, keep));
  }
  return {before.b2, after.b2};
}

TEST(BackgroundJoining, LeavesNothingFloatingAndAllElseAsItIs) {
  Floating all;
  const auto add = [&](const Floating& one) {
    all.before += one.before;
    all.after += one.after;
  };
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const double radius = seed % 2 == 0 ? 0.05 : 0.15;
    add(expect_joining_to_keep_its_word(space_of(floating_boxes(seed), policy, radius),
                                        seed % 5 == 0));
    add(expect_joining_to_keep_its_word(space_of(testing::random_map(seed, 26), policy, radius),
                                        seed % 5 == 0));
    if (HasFailure()) return;
  }
  for (const testing::Shape& shape : testing::test_shapes())
    add(expect_joining_to_keep_its_word(
        space_of(shape.map(), UnknownPolicy::kObstacle, shape.min_clearance)));
  EXPECT_GT(all.before, 350);
  EXPECT_EQ(all.after, 0);
}

/// Gravel: every fifth voxel or so is occupied. A way to what floats may lead over a peak then.
OccupancyMap gravel(unsigned seed) {
  std::mt19937 random(seed);
  return testing::make_map(0.1, {0, 0, 0}, {13, 13, 13}, [&](const VoxelIndex& v) {
    const bool on_face = v.x % 13 == 0 || v.y % 13 == 0 || v.z % 13 == 0;
    return on_face || random() % 5 == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(BackgroundJoining, WhatItRemovesComesBackInNoKernel) {
  std::size_t removed_peaks = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Space space = space_of(gravel(seed), UnknownPolicy::kObstacle, 0.05);
    const std::size_t before =
        significant_peaks(space.esdf, space.basins, space.traversable).count();
    VoxelMask& open = space.traversable;
    join_background(space.esdf, open, space.basins.not_simple_at_first_turn);
    const VoxelMask keep = significant_peaks(space.esdf, space.basins, open);
    removed_peaks += before - keep.count();
    const VoxelMask kernel = compute_kernel(space.esdf, open, space.basins);
    for (const VoxelId id : kernel.members(space.esdf.layout)) ASSERT_TRUE(open.test(id)) << seed;
    ASSERT_EQ(kernel, detail::peel_in_order(space.esdf, open, keep)) << seed;
  }
  EXPECT_GT(removed_peaks, 0u);
}

TEST(BackgroundJoining, IsTheSameForAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Space space = space_of(floating_boxes(seed), UnknownPolicy::kObstacle, 0.05);
    const auto run = [&] {
      VoxelMask open = space.traversable, not_simple = space.basins.not_simple_at_first_turn;
      join_background(space.esdf, open, not_simple);
      return std::pair(open, not_simple);
    };
    ASSERT_EQ(with_threads(1, run), with_threads(2, run));
  }
}

}  // namespace
}  // namespace ridgeway
