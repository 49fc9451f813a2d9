// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/noise.hpp"

#include <gtest/gtest.h>

#include "experiments/fusion_speed.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "support/cancelling.hpp"
#include "support/lattice.hpp"

namespace ridgeway {
namespace {

/// A room with a pillar.
World small_world() {
  World world;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = axis == 2 ? 2.0 : 4.0;
    world.planes.push_back({Eigen::Vector3d::Unit(axis), 0.0});
    world.planes.push_back({-Eigen::Vector3d::Unit(axis), -length});
  }
  world.cylinders.push_back({Point(2.0, 2.0, 1.0), 0.4, 2.0});
  return world;
}

NoiseConfig small_noise_config() {
  NoiseConfig config;
  config.voxel_sizes = {0.1, 0.2};
  config.sigmas = {0.05};
  config.poses = {.low = Point(0, 0, 0), .high = Point(4, 4, 2), .clearance = 0.4, .count = 25};
  config.min_clearance = 0.3;
  config.pairs = 40;
  config.queries = 20;
  return config;
}

TEST(Noise, EveryMapOfARoomServesEveryPair) {
  const NoiseResult result = run_noise(small_world(), small_noise_config());
  ASSERT_EQ(result.maps.size(), 4u);
  EXPECT_EQ(result.pairs, 40u);
  double least = 1e9, most = 0.0;
  for (const NoiseMap& map : result.maps) {
    EXPECT_TRUE(map.check.is_clean());
    EXPECT_EQ(map.check.queries, 20u);
    EXPECT_EQ(map.solved, result.pairs);
    EXPECT_GE(map.cycles, 1u);  // round the pillar
    EXPECT_EQ(map.built.report.graph_components, map.built.report.traversable_components);
    EXPECT_GE(map.length_ratio.median, 0.8);
    EXPECT_LE(map.length_ratio.median, 1.1);
    EXPECT_EQ(map.scan_milliseconds > 0.0, map.sigma.has_value());
    const SparseGraph& graph = map.built.roadmap.graph;
    const auto size = static_cast<double>(graph.vertices.size() + graph.edges.size());
    least = std::min(least, size);
    most = std::max(most, size);
  }
  EXPECT_DOUBLE_EQ(result.size_ratio, most / least);
  EXPECT_FALSE(result.maps[0].sigma.has_value());
  EXPECT_EQ(result.maps[1].sigma, 0.05);
}

TEST(Noise, WhatMakesNoSenseIsRefused) {
  NoiseConfig config = small_noise_config();
  config.voxel_sizes.clear();
  EXPECT_THROW(run_noise(small_world(), config), InputError);
  config = small_noise_config();
  config.sigmas = {-0.1};
  EXPECT_THROW(run_noise(small_world(), config), InputError);
}

TEST(FusionSpeed, AllWaysSeeTheSameRoom) {
  const std::vector<FusionSpeed> ways =
      run_fusion_speed(small_world(), {.poses = small_noise_config().poses});
  ASSERT_EQ(ways.size(), 4u);
  for (const FusionSpeed& way : ways) {
    EXPECT_GT(way.voxels, 10000u) << way.integrator;
    EXPECT_LT(way.error.median, 1.0) << way.integrator;
    EXPECT_GT(way.milliseconds.median, 0.0) << way.integrator;
  }
  EXPECT_LT(ways[0].mean_error, ways[2].mean_error);  // planes, not rays
  EXPECT_LT(ways[1].mean_error, ways[3].mean_error);
}

TEST(WorldMap, VoxelsAreFreeWhereTheirCentreIs) {
  const World world = small_world();
  const OccupancyMap map = occupancy_of(world, 0.1, {{0, 0, 0}, {4, 4, 2}});
  EXPECT_EQ(testing::state_at(map, {0, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(testing::state_at(map, {-1, 0, 0}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(map, {40, 39, 19}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(map, {-2, 0, 0}), VoxelState::kUnknown);
  EXPECT_EQ(testing::state_at(map, {20, 20, 10}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(map, {20, 24, 10}), VoxelState::kFree);
  const VoxelCounts counts = count_voxels(map);
  EXPECT_EQ(counts.known(), 42u * 42u * 22u);
}

TEST(Noise, CanBeCancelled) {
  const auto comparing = [](const Progress& progress) {
    run_noise(small_world(), small_noise_config(), progress);
  };
  for (const int stop : {0, 1, 3}) testing::expect_cancelled_at(stop, comparing);
}

TEST(FusionSpeed, CanBeCancelled) {
  const auto fusing = [](const Progress& progress) {
    run_fusion_speed(small_world(), {.poses = small_noise_config().poses}, progress);
  };
  for (const int stop : {0, 1, 5}) testing::expect_cancelled_at(stop, fusing);
}

}  // namespace
}  // namespace ridgeway
