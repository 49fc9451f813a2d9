// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/plain_peeling.hpp"
#include "support/betti.hpp"
#include "support/random_maps.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

using testing::Betti;
using testing::betti_numbers;
using testing::random_map;

struct Stage {
  EsdfMap esdf;
  VoxelMask traversable;
  Basins basins;
};

Stage prepare(const OccupancyMap& map, UnknownPolicy policy, double radius) {
  Stage stage;
  stage.esdf = compute_esdf(map, {.unknown = policy});
  stage.traversable = traversable_voxels(stage.esdf, radius);
  stage.basins = find_basins(stage.esdf, stage.traversable, radius);
  return stage;
}

void expect_kernel_and_opening_keep_their_word(const Stage& stage) {
  const Betti space = betti_numbers(stage.esdf.layout, stage.traversable);
  VoxelMask kernel = compute_kernel(stage.esdf, stage.traversable, stage.basins);
  const Betti of_kernel = betti_numbers(stage.esdf.layout, kernel);
  ASSERT_EQ(of_kernel, space);
  ASSERT_LE(kernel.count(), stage.traversable.count());
  open_shells(stage.esdf, kernel, significant_peaks(stage.esdf, stage.basins, stage.traversable));
  const Betti opened = betti_numbers(stage.esdf.layout, kernel);
  ASSERT_EQ(opened.b0, space.b0);
  ASSERT_EQ(opened.b2, 0);
  ASSERT_GE(opened.b1, space.b1);
}

TEST(Kernel, KeepsTopologyAndOpeningMakesCurvesOnRandomMaps) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const Stage stage = prepare(random_map(seed, 26), policy, seed % 2 == 0 ? 0.05 : 0.15);
    expect_kernel_and_opening_keep_their_word(stage);
    if (HasFatalFailure()) return;
  }
}

TEST(Kernel, KeepsTopologyOnTheTestShapes) {
  for (const testing::Shape& shape : testing::test_shapes()) {
    SCOPED_TRACE(shape.name);
    expect_kernel_and_opening_keep_their_word(
        prepare(shape.map(), UnknownPolicy::kObstacle, shape.min_clearance));
    if (HasFatalFailure()) return;
  }
}

TEST(Kernel, OpensTheShellAroundAFloatingObstacleIntoCurves) {
  for (const char* name : {"floating_box", "sphere_in_sphere"}) {
    SCOPED_TRACE(name);
    const testing::Shape shape = testing::test_shape(name);
    const Stage stage = prepare(shape.map(), UnknownPolicy::kObstacle, shape.min_clearance);
    VoxelMask kernel = compute_kernel(stage.esdf, stage.traversable, stage.basins);
    const std::size_t shell = kernel.count();
    ASSERT_EQ(betti_numbers(stage.esdf.layout, kernel).b2, 1);
    open_shells(stage.esdf, kernel, significant_peaks(stage.esdf, stage.basins, stage.traversable));
    EXPECT_LT(kernel.count(), shell / 2);
    EXPECT_GT(kernel.count(), 0u);
  }
}

VoxelMask peel_in_order(const Stage& stage) {
  return detail::peel_in_order(stage.esdf, stage.traversable,
                               significant_peaks(stage.esdf, stage.basins, stage.traversable));
}

TEST(Kernel, IsWhatPeelingEveryVoxelInOrderLeaves) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const Stage stage = prepare(random_map(seed, 30), policy, seed % 2 == 0 ? 0.05 : 0.15);
    ASSERT_EQ(compute_kernel(stage.esdf, stage.traversable, stage.basins), peel_in_order(stage))
        << seed;
  }
  for (const testing::Shape& shape : testing::test_shapes()) {
    const Stage stage = prepare(shape.map(), UnknownPolicy::kObstacle, shape.min_clearance);
    ASSERT_EQ(compute_kernel(stage.esdf, stage.traversable, stage.basins), peel_in_order(stage))
        << shape.name;
  }
}

TEST(Kernel, IsTheSameForAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Stage stage = prepare(random_map(seed, 60), UnknownPolicy::kObstacle, 0.05);
    const auto run = [&] {
      VoxelMask kernel = compute_kernel(stage.esdf, stage.traversable, stage.basins);
      open_shells(stage.esdf, kernel,
                  significant_peaks(stage.esdf, stage.basins, stage.traversable));
      return kernel;
    };
    ASSERT_EQ(with_threads(1, run), with_threads(2, run));
  }
}

}  // namespace
}  // namespace ridgeway
