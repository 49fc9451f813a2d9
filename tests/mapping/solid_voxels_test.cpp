// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mapping/solid_voxels.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "sensing/random_worlds.hpp"

namespace ridgeway {
namespace {

TEST(SolidVoxels, NoSolidReachesIntoAFreeVoxelAndOccupiedOnesAreNearOne) {
  const World house = load_world(std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml");
  const auto extent = extent_of(house);
  ASSERT_TRUE(extent);
  EXPECT_EQ(extent->max, Point(15, 10, 5));
  World round;
  round.spheres.push_back({{0.3, 0.1, 0.2}, 1.1});
  round.cylinders.push_back({{2.5, 0.4, 0.1}, 0.4, 2.0});
  round.boxes.push_back({{-2.5, 0.0, 0.0}, {0.02, 3.0, 0.02}});
  Random random(3, 3);
  for (const auto& [world, voxel_size] : {std::pair{&house, 0.23}, {&round, 0.11}}) {
    const OccupancyMap map = touched_by(*world, voxel_size, *extent_of(*world), "world");
    for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
      if (map.state[id] == VoxelState::kUnknown) continue;
      const Point centre = to_world(map, centre_of(map.layout.index_of(id), map.voxel_size));
      if (map.state[id] == VoxelState::kOccupied) {
        ASSERT_LE(surface_distance(*world, centre).distance, 0.8661 * voxel_size);
        continue;
      }
      for (int i = 0; i < 4; ++i) {
        const Point p = centre + 0.4999 * voxel_size * testing::random_vector(random, -1.0, 1.0);
        ASSERT_GT(surface_distance(*world, p).distance, 0.0) << p.transpose();
      }
    }
  }
}

TEST(SolidVoxels, AWorldWithoutAnEndHasNoExtent) {
  World world;
  EXPECT_FALSE(extent_of(world));
  world.planes.push_back({Eigen::Vector3d::UnitZ(), 0.0});
  EXPECT_FALSE(extent_of(world));
}

}  // namespace
}  // namespace ridgeway
