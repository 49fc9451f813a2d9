// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// What rays, and images without carving, make of a map, wherever it lies on the lattice.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/sensing/depth_camera.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

/// A room of 10 x 8 x 3 m with a pole of 10 cm in its middle.
World room_with_pole() {
  World world;
  world.planes = {{Point(0, 0, 1), 0},    {Point(0, 0, -1), -3}, {Point(1, 0, 0), 0},
                  {Point(-1, 0, 0), -10}, {Point(0, 1, 0), 0},   {Point(0, -1, 0), -8}};
  world.cylinders.push_back({Point(5.03, 4.06, 1.5), 0.05, 3.0});
  return world;
}

bool is_pole_whole(const OccupancyMap& map) {
  for (double z = 0.9; z < 2.0; z += 0.1) {
    const VoxelIndex pole = voxel_at(Point(5.03, 4.06, z), map.voxel_size) - map.origin;
    bool is_there = false;
    for (int d = 0; d < 27; ++d) is_there |= map.at(pole + offset_of(d)) == VoxelState::kOccupied;
    if (!is_there) return false;
  }
  return true;
}

/// A scan has many rays past a pole for each that meets it; they are one look.
TEST(FusionByRays, WhatStandsStillIsNotForgotten) {
  const World world = room_with_pole();
  SpinningLidar lidar;
  lidar.max_range = 30.0;
  lidar.rows = 64;
  lidar.columns = 900;
  lidar.vertical = 1.2;
  for (const int forget_after : {0, 3, 8}) {
    Random random(11);
    FusionConfig config;
    config.voxel_size = 0.1;
    config.forget_after = forget_after;
    TsdfFusion fusion(config);
    for (std::uint64_t scan = 0; scan < 12; ++scan) {
      const double angle = random.uniform(-3.1, 3.1), far = random.uniform(1.0, 3.0);
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = Point(5 + far * std::cos(angle), 4 + far * std::sin(angle), 1.4);
      fusion.integrate(scan_with(world, lidar, pose, scan), pose);
      if (scan > 2)
        EXPECT_TRUE(is_pole_whole(occupancy_of(fusion.map()))) << forget_after << ", " << scan;
    }
  }
}

/// A level scan may lie in the plane between two blocks, up to rounding.
TEST(FusionByRays, ALevelScanIsSeenAtAnyHeight) {
  std::vector<Point> square;
  for (int i = 0; i < 720; ++i) {
    const double angle = i * std::numbers::pi / 360.0;
    const double range = 2.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    square.emplace_back(range * std::cos(angle), range * std::sin(angle), 0.0);
  }
  const std::vector<Point> below{Point(0, 0, -0.5)};
  std::size_t expected = 0;
  for (const auto& [first, height] : {std::pair(-0.83, 6.02), std::pair(-0.8, 6.0),
                                      std::pair(-0.85, 5.95), std::pair(-0.7, 12.9)}) {
    FusionConfig config;
    config.voxel_size = 0.05;
    TsdfFusion fusion(config);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Point(0.02, 0.03, first);
    fusion.integrate(below, pose);
    const std::size_t before = count_voxels(occupancy_of(fusion.map())).occupied;
    pose.translation().z() = height;
    fusion.integrate(square, pose);
    const std::size_t occupied = count_voxels(occupancy_of(fusion.map())).occupied - before;
    if (expected == 0) expected = occupied;
    EXPECT_GT(occupied, 300u);
    EXPECT_NEAR(static_cast<double>(occupied), static_cast<double>(expected),
                0.1 * static_cast<double>(expected))
        << height;
  }
}

TEST(FusionWithoutCarving, DoesNotDependOnWhereBlocksBegin) {
  const PinholeCamera camera{80, 60, 60, 60, 39.5, 29.5};
  const DepthImage wall{80, 60, std::vector<float>(4800, 5.0f)};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.translation() = Point(0.05, 0.05, 0.05);
  for (int x = 0; x < 8; ++x) {
    FusionConfig config;
    config.voxel_size = 0.1;
    config.truncation = 1.5;
    config.depth_behind = 0.2;
    config.carve = false;
    config.origin = VoxelIndex{x, 0, 0};
    TsdfFusion fusion(config);
    fusion.integrate(wall, camera, pose);
    const OccupancyMap map = occupancy_of(fusion.map());
    int free = 0;
    for (int i = 0; i < 50; ++i)
      free += map.at(VoxelIndex{i, 0, 0} - map.origin) == VoxelState::kFree;
    EXPECT_NEAR(free, 15, 1) << x;
  }
}

TEST(TsdfFusion, AMapThatIsSeenFarBehindItsSurfacesIsSavedAndRead) {
  FusionConfig config;
  config.voxel_size = config.truncation = 0.1;
  config.depth_behind = 0.8;
  TsdfFusion fusion(config);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Point(5.0, 2.0, 1.5);
  fusion.integrate(scan_with(room_with_pole(), SpinningLidar{}, pose, 1), pose);
  const TsdfMap map = fusion.map();
  for (const float distance : map.distance.values())
    ASSERT_LE(std::abs(distance), map.truncation * (1.0 + 1e-6));
  const TemporaryFolder folder;
  save_tsdf(map, "", folder / "a.ridge");
  EXPECT_EQ(load_tsdf(folder / "a.ridge").distance.values().size(), map.distance.values().size());
  config.max_weight = 1e-50;  // none in single precision
  EXPECT_THROW(config.validate(), InputError);
}

}  // namespace
}  // namespace ridgeway
