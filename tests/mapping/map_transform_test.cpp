// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mapping/random_map.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"

namespace ridgeway {
namespace {

Eigen::Isometry3d motion(double roll, double pitch, double yaw, const Point& shift) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = shift;
  result.rotate(Eigen::AngleAxisd(yaw, Point::UnitZ()) * Eigen::AngleAxisd(pitch, Point::UnitY()) *
                Eigen::AngleAxisd(roll, Point::UnitX()));
  return result;
}

TEST(LatticeTransform, MovesCentresLikeTheIsometry) {
  constexpr double quarter = std::numbers::pi / 2;
  for (int turns = 0; turns < 64; ++turns) {
    const auto T = motion(quarter * (turns & 3), quarter * (turns >> 2 & 3), quarter * (turns >> 4),
                          {0.3, -2.0, 0.1 * turns});
    const auto lattice = find_lattice_transform(T, 0.1);
    ASSERT_TRUE(lattice) << turns;
    for (const VoxelIndex v : {VoxelIndex{0, 0, 0}, {-5, 7, 11}, {100, -3, 2}}) {
      const VoxelIndex moved = (*lattice)({v, v}).min;
      EXPECT_LT((T * centre_of(v, 0.1) - centre_of(moved, 0.1)).norm(), 1e-9);
    }
  }
}

TEST(LatticeTransform, IsNotFoundWhereVoxelsDoNotMeetVoxels) {
  EXPECT_FALSE(find_lattice_transform(motion(0, 0, 0.01, {0, 0, 0}), 0.1));
  EXPECT_FALSE(find_lattice_transform(motion(0, 0, 0, {0.05, 0, 0}), 0.1));
}

TEST(LatticeTransform, IsNotFoundForATurnHoweverSmall) {
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.rotate(Eigen::AngleAxisd(1e-4, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(find_lattice_transform(turn, 0.1));
}

TEST(TransformMap, AgreesWithTheLatticeWhereThatIsExact) {
  const OccupancyMap map = testing::clumped_map(5);
  const auto T = motion(0, 0, std::numbers::pi / 2, {0.3, -0.7, 1.1});
  const auto lattice = find_lattice_transform(T, 0.1);
  ASSERT_TRUE(lattice);
  const OccupancyMap moved = transform_map(map, T, 0.1);
  EXPECT_EQ(count_voxels(moved).free, count_voxels(map).free);
  testing::for_each_known(map, [&](const VoxelIndex& v, VoxelState state) {
    EXPECT_EQ(testing::state_at(moved, (*lattice)({v, v}).min), state);
  });
}

TEST(TransformMap, NeverLosesAnObstacleNorInventsFreeSpace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3.2, 3.2), part(1e-6, 1.0 - 1e-6);
  for (unsigned seed = 0; seed < 12; ++seed) {
    const OccupancyMap map = testing::clumped_map(seed);
    const auto T = motion(angle(random), angle(random), angle(random),
                          {angle(random), angle(random), angle(random)});
    const OccupancyMap moved = transform_map(map, T, seed % 3 == 0 ? 0.1 : 0.1 + 0.03 * seed);
    std::size_t free = 0;
    testing::for_each_known(map, [&](const VoxelIndex& v, VoxelState state) {
      if (state != VoxelState::kOccupied) return;
      for (int i = 0; i < 10; ++i) {
        const Point p =
            0.1 * (Point(v.x, v.y, v.z) + Point(part(random), part(random), part(random)));
        EXPECT_EQ(testing::state_at(moved, voxel_at(T * p, moved.voxel_size)),
                  VoxelState::kOccupied);
      }
    });
    testing::for_each_known(moved, [&](const VoxelIndex& v, VoxelState state) {
      if (state != VoxelState::kFree) return;
      ++free;
      for (int i = 0; i < 10; ++i) {
        const Point p = moved.voxel_size *
                        (Point(v.x, v.y, v.z) + Point(part(random), part(random), part(random)));
        EXPECT_EQ(testing::state_at(map, voxel_at(T.inverse() * p, 0.1)), VoxelState::kFree);
      }
    });
    EXPECT_GT(free, 0u);
  }
}

TEST(TransformMap, GrowsObstaclesByNoMoreThanADiagonal) {
  const OccupancyMap map = testing::clumped_map(8);
  const auto T = motion(0.3, 0.2, 0.7, {0.01, 0.02, 0.03});
  const OccupancyMap moved = transform_map(map, T, 0.1);
  testing::for_each_known(moved, [&](const VoxelIndex& v, VoxelState state) {
    if (state != VoxelState::kOccupied) return;
    const Point p = T.inverse() * centre_of(v, 0.1);
    double nearest = 1e9;
    testing::for_each_known(map, [&](const VoxelIndex& u, VoxelState other) {
      if (other == VoxelState::kOccupied)
        nearest = std::min(nearest, (centre_of(u, 0.1) - p).norm());
    });
    EXPECT_LT(nearest, 0.1 * std::sqrt(3.0) + 1e-9);
  });
}

TEST(TransformMap, RefusesWhatIsNoMotion) {
  const OccupancyMap map = testing::clumped_map(1);
  Eigen::Isometry3d scaled = Eigen::Isometry3d::Identity(), mirrored = scaled, nowhere = scaled;
  scaled.linear() *= 2.0;
  mirrored.linear()(0, 0) = -1.0;
  nowhere.translation().x() = std::nan("");
  for (const auto& T : {scaled, mirrored, nowhere})
    EXPECT_THROW(transform_map(map, T, 0.1), InputError);
  EXPECT_THROW(transform_map(map, Eigen::Isometry3d::Identity(), 0.05), InputError);
}

}  // namespace
}  // namespace ridgeway
