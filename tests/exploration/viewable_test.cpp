// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/viewable.hpp"

#include <gtest/gtest.h>

#include "sensing/test_meshes.hpp"

namespace ridgeway {
namespace {

/// Four walls and a ceiling without thickness, in the middle of a hall of 10 x 10 x 2 m.
World tent_in_a_hall() {
  testing::TriangleList tent = testing::box_mesh({0.0, 0.0, 1.0}, {4.0, 4.0, 2.0});
  tent.triangles.resize(tent.triangles.size() - 2);  // the floor is the hall's
  World world;
  for (const double side : {1.0, -1.0}) {
    world.planes.push_back({side * Eigen::Vector3d::UnitX(), -5.0});
    world.planes.push_back({side * Eigen::Vector3d::UnitY(), -5.0});
  }
  world.planes.push_back({Eigen::Vector3d::UnitZ(), 0.0});
  world.planes.push_back({-Eigen::Vector3d::UnitZ(), -2.0});
  world.meshes.push_back({std::make_shared<SolidMesh>(tent.vertices, tent.triangles), 1.0,
                          Eigen::Isometry3d::Identity(), ""});
  return world;
}

TEST(ViewableVolume, EndsAtAMeshOfThinWalls) {
  const VoxelRange hall = voxels_inside({{-5.0, -5.0, 0.0}, {5.0, 5.0, 2.0}}, 0.2);
  const World world = tent_in_a_hall();
  const FieldOfView view = field_of_view(DepthSensor{});
  const ViewableVolume inside(world, 0.2, hall, {0.1, 0.1, 1.0}, 0.4, view);
  const ViewableVolume outside(world, 0.2, hall, {4.1, 4.1, 1.0}, 0.4, view);
  EXPECT_LT(inside.volume(), 32.0);
  EXPECT_GT(inside.volume(), 20.0);
  EXPECT_LT(outside.volume(), 200.0 - 32.0);
  EXPECT_GT(outside.volume(), 120.0);
}

/// A wall of 2 cm between the centres of voxels, of which none is occupied.
TEST(ViewableVolume, EndsAtAWallThatIsThinnerThanAVoxel) {
  const VoxelRange rooms = voxels_inside({{-5.0, -5.0, 0.0}, {5.0, 5.0, 2.0}}, 0.2);
  World world = tent_in_a_hall();
  world.meshes.clear();
  const FieldOfView view = field_of_view(DepthSensor{});
  const ViewableVolume whole(world, 0.2, rooms, {2.1, 0.1, 1.0}, 0.4, view);
  EXPECT_GT(whole.volume(), 160.0);
  world.boxes.push_back({{1.0, 0.0, 1.0}, {0.02, 10.0, 2.0}});
  const ViewableVolume beside(world, 0.2, rooms, {2.1, 0.1, 1.0}, 0.4, view);
  EXPECT_GT(beside.volume(), 0.35 * whole.volume());
  EXPECT_LT(beside.volume(), 0.41 * whole.volume());
}

}  // namespace
}  // namespace ridgeway
