// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration/expected_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ridgeway {
namespace {

constexpr double kVoxelSize = 0.25;
constexpr int kSide = 6 * kBlockSide;  // voxels of the map along each axis: 12 m
const Point kCentre = Point::Constant(0.5 * kSide * kVoxelSize + 0.01);

/// Unknown but for a free ball around the centre.
OccupancyMap unknown_around(double free_radius) {
  OccupancyMap map;
  map.voxel_size = kVoxelSize;
  std::vector<BlockIndex> blocks;
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 6; ++x) blocks.push_back({x, y, z});
  map.layout = BlockLayout(blocks);
  map.state = VoxelField<VoxelState>(map.layout, VoxelState::kUnknown);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if ((centre_of(map.layout.index_of(id), kVoxelSize) - kCentre).norm() <= free_radius)
      map.state[id] = VoxelState::kFree;
  return map;
}

void wall_at(OccupancyMap& map, int x) {
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    if (map.layout.index_of(id).x == x) map.state[id] = VoxelState::kOccupied;
}

double expected(const OccupancyMap& map, const VoxelRange& within = kAllVoxels, double yaw = 0.0) {
  const FieldOfView view = {.range = 5.0};
  return detail::expected_voxels(compute_esdf(map), view, within, kCentre, yaw);
}

TEST(ExpectedVolume, IsThatOfAllVoxelsInView) {
  constexpr double kFree = 1.5, kRange = 5.0, kMeanFree = 4.0;
  const OccupancyMap map = unknown_around(kFree);
  const FieldOfView view;
  double brute = 0.0;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const Eigen::Vector3d way = centre_of(map.layout.index_of(id), kVoxelSize) - kCentre;
    const double distance = way.norm();
    if (map.state[id] != VoxelState::kUnknown || distance > kRange) continue;
    if (std::abs(way.y()) > way.x() || std::abs(way.z()) > std::tan(0.5 * view.vertical) * way.x())
      continue;
    const double share = distance / kRange;
    brute += (1.0 - share * share) * std::exp(-(distance - kFree) / kMeanFree);
  }
  EXPECT_NEAR(expected(map), brute, 0.05 * brute);
}

TEST(ExpectedVolume, IsNothingWhereAllIsKnownOrHidden) {
  EXPECT_EQ(expected(unknown_around(6.0)), 0.0);
  OccupancyMap map = unknown_around(1.5);
  const double open = expected(map);
  wall_at(map, kSide / 2 + 4);  // in the ball
  EXPECT_EQ(expected(map), 0.0);
  EXPECT_NEAR(expected(map, kAllVoxels, std::acos(-1.0)), open, 0.05 * open);
}

TEST(ExpectedVolume, IsOfVoxelsWithinAlone) {
  const OccupancyMap map = unknown_around(1.5);
  const VoxelRange ball = {VoxelIndex{kSide / 2 - 4, 0, 0},
                           VoxelIndex{kSide / 2 + 4, kSide, kSide}};
  EXPECT_LT(expected(map, ball), 0.1 * expected(map));
  EXPECT_NEAR(expected(map, {VoxelIndex{0, 0, 0}, VoxelIndex{kSide, kSide, kSide}}), expected(map),
              1e-9);
}

}  // namespace
}  // namespace ridgeway
