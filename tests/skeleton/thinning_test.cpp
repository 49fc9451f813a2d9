// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/simple_point.hpp"
#include "support/betti.hpp"
#include "support/random_shapes.hpp"

namespace ridgeway {
namespace {

using testing::Betti;
using testing::betti_numbers;
using testing::random_shape;
using testing::RandomShape;

Cube27 random_cube(std::mt19937& random) { return static_cast<Cube27>(random()) & kAllCells; }

/// The neighbours of a cube as a set of their own.
Betti betti_of_neighbours(Cube27 cube) {
  const BlockLayout layout({{0, 0, 0}});
  VoxelMask mask(layout);
  for (int d = 0; d < 27; ++d)
    if (d != kCentre && (cube >> d & 1) != 0)
      mask.set(layout.find(VoxelIndex{3, 3, 3} + offset_of(d)));
  return betti_numbers(layout, mask);
}

TEST(SimplePoint, IsWhereTheNeighboursAloneAreLikeAPoint) {
  std::mt19937 random(1);
  int simple = 0;
  for (int i = 0; i < 20000; ++i) {
    Cube27 cube = random_cube(random);
    if (i % 2 == 0) cube |= random_cube(random);  // dense and sparse ones
    if (i % 5 == 0) cube &= random_cube(random);
    const bool expected = betti_of_neighbours(cube) == Betti{1, 0, 0};
    ASSERT_EQ(is_simple(cube), expected) << cube;
    simple += expected;
  }
  EXPECT_GT(simple, 1000);
}

TEST(SimplePoint, PartsAgreeWithTheTest) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    const Cube27 cube = random_cube(random);
    ASSERT_EQ(is_simple(cube), foreground_parts(cube) == 1 && background_parts(cube) == 1);
  }
}

constexpr Cube27 cells(std::initializer_list<VoxelIndex> offsets) {
  Cube27 cube = kCentreBit;
  for (const VoxelIndex& o : offsets) cube |= 1u << direction_of(o);
  return cube;
}

TEST(CurveEnd, CornerTemplateHasAllTwentyFourOrientations) {
  int orientations = 0;
  for (int octant = 0; octant < 8; ++octant) {
    const int x = octant & 1 ? 1 : -1, y = octant & 2 ? 1 : -1, z = octant & 4 ? 1 : -1;
    const VoxelIndex faces[3] = {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
    const VoxelIndex diagonals[4] = {{x, y, 0}, {x, 0, z}, {0, y, z}, {x, y, z}};
    for (const VoxelIndex& face : faces) {
      Cube27 cube = kCentreBit | 1u << direction_of(face);
      for (const VoxelIndex& diagonal : diagonals) cube |= 1u << direction_of(diagonal);
      orientations += is_curve_end(cube);
    }
  }
  EXPECT_EQ(orientations, 24);
  EXPECT_TRUE(is_curve_end(cells({{1, 0, 0}, {1, 1, 0}})));    // end of a curve of 6-steps
  EXPECT_TRUE(is_curve_end(cells({{1, 1, 1}})));               // one 26-neighbour
  EXPECT_FALSE(is_curve_end(cells({{1, 0, 0}, {-1, 0, 0}})));  // middle of a line
  EXPECT_FALSE(is_curve_end(cells({{1, 0, 0}, {0, 1, 0}})));   // an elbow
  EXPECT_FALSE(is_curve_end(cells({{1, 0, 0}, {-1, 1, 0}})));  // middle of a curve
}

TEST(Thinning, TemplatesMatchInEveryOrientation) {
  // Template A from each face, none of them for a lone line's middle.
  for (int d = 0; d < 27; ++d) {
    if (squared_length(d) != 1) continue;
    const VoxelIndex o = offset_of(d);
    EXPECT_TRUE(matches_deletion_template(cells({{-o.x, -o.y, -o.z}})));
  }
  EXPECT_FALSE(matches_deletion_template(cells({{1, 0, 0}, {-1, 0, 0}})));
  EXPECT_FALSE(matches_deletion_template(kAllCells));
}

TEST(Thinning, KeepsBettiNumbersOnRandomShapes) {
  long tunnels = 0, cavities = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    RandomShape shape = random_shape(seed);
    const Betti before = betti_numbers(shape.layout, shape.voxels);
    thin(shape.layout, shape.voxels);
    ASSERT_EQ(betti_numbers(shape.layout, shape.voxels), before) << "seed " << seed;
    tunnels += before.b1;
    cavities += before.b2;
  }
  EXPECT_GT(tunnels, 400);  // the shapes do have something to lose
  EXPECT_GT(cavities, 50);
}

TEST(Thinning, LeavesNoSimpleVoxelButEnds) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomShape shape = random_shape(seed);
    thin(shape.layout, shape.voxels);
    for (const VoxelId id : shape.voxels.members(shape.layout)) {
      const Cube27 cube = cube_around(shape.layout, shape.voxels, id);
      ASSERT_TRUE(!is_simple(cube) || is_curve_end(cube)) << "seed " << seed;
    }
  }
}

TEST(Thinning, IsTheSameForAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomShape one = random_shape(seed, 60), two = one;
    with_threads(1, [&] { thin(one.layout, one.voxels); });
    with_threads(2, [&] { thin(two.layout, two.voxels); });
    ASSERT_EQ(one.voxels, two.voxels);
  }
}

}  // namespace
}  // namespace ridgeway
