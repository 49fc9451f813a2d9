// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mapping/solid_voxels.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "sensing/random_worlds.hpp"
#include "sensing/test_meshes.hpp"

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

TEST(SolidVoxels, NoWayBetweenFreeVoxelsLeadsThroughAMeshOfThinWalls) {
  testing::TriangleList walls = testing::box_mesh({0.1, 0.2, 0.3}, {2.0, 1.5, 1.0});
  walls.triangles.resize(walls.triangles.size() - 2);  // open, so that it has no inside
  World world;
  Eigen::Isometry3d turned(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  world.meshes.push_back(
      {std::make_shared<SolidMesh>(walls.vertices, walls.triangles), 1.0, turned, ""});
  const OccupancyMap map = occupancy_of(world, 0.13, {{-2, -2, -2}, {2, 2, 2}});
  const auto centre_at = [&](const VoxelIndex& voxel) {
    return to_world(map, centre_of(voxel, map.voxel_size));
  };
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const Point centre = centre_at(map.layout.index_of(id));
    if (map.state[id] == VoxelState::kOccupied)
      ASSERT_LE(surface_distance(world, centre).distance, 0.8661 * map.voxel_size);
    if (map.state[id] != VoxelState::kFree) continue;
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex next = map.layout.index_of(id) + offset_of(d);
      if (offset_of(d) == VoxelIndex{} || map.at(next) != VoxelState::kFree) continue;
      const Eigen::Vector3d way = centre_at(next) - centre;
      ASSERT_GE(cast_ray(world, centre, way.normalized()), way.norm());
    }
  }
}

/// Whether a cube shares a point with a segment, to rounding.
bool touches(const Point& centre, double side, const Point& a, const Point& b) {
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double from = a[axis] - centre[axis], way = b[axis] - a[axis];
    const double low = (-0.5 * side - from) / way, high = (0.5 * side - from) / way;
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  return first <= last;
}

/// A tetrahedron that is turned and scaled: what its surface cuts is known by its edges, and by
/// edges of voxels, which meet it.
TEST(SolidVoxels, AMeshTakesTheVoxelsThatItTouchesOrEncloses) {
  const std::vector<Point> corners = {{0, 0, 0}, {1, 0.1, 0.2}, {0.2, 1.1, 0.1}, {0.3, 0.2, 1.2}};
  const std::vector<Triangle> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  World world;
  Eigen::Isometry3d placed(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  placed.translation() = Point(0.4, -0.3, 0.2);
  world.meshes.push_back({std::make_shared<SolidMesh>(corners, triangles), 2.0, placed, ""});
  ASSERT_TRUE(world.meshes[0].mesh->is_closed());
  const double s = 0.11;
  const OccupancyMap map = touched_by(world, s, *extent_of(world), "world");
  std::size_t enclosed = 0, touched = 0;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (map.state[id] == VoxelState::kUnknown) continue;
    const Point centre = to_world(map, centre_of(map.layout.index_of(id), s));
    bool expected = surface_distance(world, centre).distance <= 0.5 * s;  // inside, or in its ball
    enclosed += expected;
    for (int axis = 0; axis < 3; ++axis)
      for (const double u : {-0.5 * s, 0.5 * s})
        for (const double v : {-0.5 * s, 0.5 * s}) {
          Point from = centre;
          from[axis] -= 0.5 * s;
          from[(axis + 1) % 3] += u;
          from[(axis + 2) % 3] += v;
          expected |= cast_ray(world, from, Eigen::Vector3d::Unit(axis)) <= s;
        }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        expected |= touches(centre, s, placed * (2.0 * corners[static_cast<std::size_t>(i)]),
                            placed * (2.0 * corners[static_cast<std::size_t>(j)]));
    touched += expected;
    ASSERT_EQ(map.state[id] == VoxelState::kOccupied, expected) << centre.transpose();
  }
  EXPECT_GT(enclosed, 300u);
  EXPECT_GT(touched, enclosed + 100);
}

World world_of(const std::vector<testing::TriangleList>& meshes) {
  World world;
  for (const testing::TriangleList& mesh : meshes)
    world.meshes.push_back({std::make_shared<SolidMesh>(mesh.vertices, mesh.triangles), 1.0,
                            Eigen::Isometry3d::Identity(), ""});
  return world;
}

/// Boxes that overlap, or of which one lies within the other: in one mesh they take the voxels that
/// they take as two, whatever the bounds.
TEST(SolidVoxels, AMeshThatCutsThroughItselfIsSolidWithin) {
  const testing::TriangleList large = testing::box_mesh(Point::Zero(), {4.0, 4.0, 4.0});
  for (const Point& centre : {Point(2.5, 0.2, 0.1), Point(0.2, 0.1, -0.2)}) {
    const testing::TriangleList small = testing::box_mesh(centre, {2.6, 1.8, 1.8});
    testing::TriangleList both = large;
    append(small, false, both);
    for (const double low : {-3.0, -2.7, -2.1}) {
      const Box bounds = {Point::Constant(low), Point::Constant(4.5)};
      const OccupancyMap apart = touched_by(world_of({large, small}), 0.1, bounds, "world");
      const OccupancyMap one = touched_by(world_of({both}), 0.1, bounds, "world");
      std::size_t occupied = 0;
      for (VoxelId id = 0; id < apart.layout.voxel_count(); ++id) {
        ASSERT_EQ(one.state[id], apart.state[id]) << id;
        occupied += one.state[id] == VoxelState::kOccupied;
      }
      EXPECT_GT(occupied, 64000u);
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
