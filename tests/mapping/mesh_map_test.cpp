// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mapping/mesh_map.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "sensing/test_meshes.hpp"
#include "support/refusal.hpp"

namespace ridgeway {
namespace {

using testing::TriangleList;

TriangleSoup turned(const TriangleList& mesh, Random& random, double scale) {
  const Eigen::Quaterniond turn(Eigen::Vector4d(random.uniform(-1, 1), random.uniform(-1, 1),
                                                random.uniform(-1, 1), random.uniform(-1, 1))
                                    .normalized());
  const Point by = testing::random_vector(random, -100.0, 100.0);
  TriangleSoup all;
  for (const Point& v : mesh.vertices) all.vertices.push_back(turn * (scale * v) + by);
  all.triangles = mesh.triangles;
  return all;
}

VoxelState state_at(const OccupancyMap& map, const Point& p) {
  return map.at(voxel_at(p, map.voxel_size) - map.origin);
}

/// What was reached from outside is outside.
void expect_outside(const OccupancyMap& map, const SolidMesh& solid) {
  std::size_t free = 0;
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (map.state[id] != VoxelState::kFree) continue;
    ++free;
    const Point here = to_world(map, centre_of(map.layout.index_of(id), map.voxel_size));
    ASSERT_GT(solid.distance(here).distance, 0.0) << here.transpose();
  }
  EXPECT_GT(free, 1000u);
}

TEST(MeshMap, NothingLeaksThroughAClosedSurfaceAtAnyVoxelSizeAndRotation) {
  Random random(7, 1);
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    for (const double voxel_size : {0.09, 0.13, 0.17, 0.31}) {
      const TriangleSoup mesh = turned(testing::spiky_mesh(seed), random, 0.7);
      const SolidMesh solid(mesh.vertices, mesh.triangles);
      MeshMapReport report;
      MeshMapConfig config{.voxel_size = voxel_size, .bounds = {}, .inside = {}, .margin = 0};
      const Box box = box_around(mesh, "mesh");
      const Point room = Point::Constant(3.0 * voxel_size);
      config.bounds = Box{box.min - room, box.max + room};
      config.inside = {box.min - 2.0 * Point::Constant(voxel_size)};
      expect_outside(map_from_mesh(mesh, config, "mesh", &report), solid);
      EXPECT_TRUE(report.leak.has_value());  // what is around is open to the bounds
    }
}

TEST(MeshMap, RaysBetweenFreeVoxelsMeetTheSurfaceOnlyWhereAVoxelIsOccupied) {
  Random random(8, 1);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const TriangleSoup mesh = turned(testing::spiky_mesh(seed), random, 0.9);
    const TriangleTree tree(mesh.vertices, mesh.triangles);
    const OccupancyMap map =
        map_from_mesh(mesh, {.voxel_size = 0.09, .bounds = {}, .inside = {}, .margin = 0}, "mesh");
    const Box box = box_around(mesh, "mesh");
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      Point from;
      for (int axis = 0; axis < 3; ++axis)
        from[axis] = random.uniform(box.min[axis], box.max[axis]);
      const Eigen::Vector3d direction = testing::random_vector(random, -1.0, 1.0).normalized();
      const TriangleTree::Hit hit = tree.first_hit(from, direction);
      if (!std::isfinite(hit.range)) continue;
      ++hits;
      // The place that was hit lies in the closed cube of an occupied voxel.
      const Point place = from + hit.range * direction;
      EXPECT_EQ(state_at(map, place), VoxelState::kOccupied) << place.transpose();
    }
    EXPECT_GT(hits, 300);
  }
}

/// A room of 6 x 4 x 3 m, its walls sheets, in a larger map.
MeshMapConfig around_room() {
  return {.voxel_size = 0.1,
          .bounds = Box{{-5, -4, -3}, {5, 4, 3}},
          .inside = {{0, 0, 0}},
          .margin = 0};
}

TriangleSoup soup(const TriangleList& mesh) { return {mesh.vertices, mesh.triangles}; }

TEST(MeshMap, ASeedMakesTheInsideFreeAndLeavesTheRestUnknown) {
  MeshMapReport report;
  const OccupancyMap map =
      map_from_mesh(soup(testing::box_mesh({0, 0, 0}, {6, 4, 3})), around_room(), "room", &report);
  EXPECT_FALSE(report.leak);
  EXPECT_EQ(state_at(map, {0, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(state_at(map, {3.01, 0, 0}), VoxelState::kOccupied);
  EXPECT_EQ(state_at(map, {4, 0, 0}), VoxelState::kUnknown);
  EXPECT_NEAR(static_cast<double>(count_voxels(map).free), 58.0 * 38.0 * 28.0, 1.0);
}

TEST(MeshMap, ALeakIsReportedWhereItIsNarrowest) {
  // The room without a triangle, but a wall with a window of 0.5 m in its place.
  TriangleList room = testing::box_mesh({0, 0, 0}, {6, 4, 3});
  std::erase_if(room.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](auto v) { return room.vertices[v].x() > 2.9; });
  });
  const auto panel = [&](double y0, double z0, double y1, double z1) {
    const auto first = static_cast<std::uint32_t>(room.vertices.size());
    for (const auto& [y, z] : {std::pair{y0, z0}, {y1, z0}, {y1, z1}, {y0, z1}})
      room.vertices.emplace_back(3.0, y, z);
    room.triangles.push_back({first, first + 1, first + 2});
    room.triangles.push_back({first, first + 2, first + 3});
  };
  panel(-2.0, -1.5, 0.75, 1.5);
  panel(1.25, -1.5, 2.0, 1.5);
  panel(0.75, -1.5, 1.25, 0.25);
  panel(0.75, 0.75, 1.25, 1.5);
  MeshMapReport report;
  map_from_mesh(soup(room), around_room(), "room", &report);
  ASSERT_TRUE(report.leak);
  EXPECT_NEAR((report.leak->narrowest - Point(3.0, 1.0, 0.5)).norm(), 0.0, 0.3);
  EXPECT_NEAR(report.leak->width, 0.4, 0.21);
  EXPECT_GT((report.leak->exit.cwiseAbs() - Point(4.8, 3.8, 2.8)).maxCoeff(), 0.0);
  // A seed in a corner, nearer to walls than the window is wide, changes nothing of that.
  MeshMapConfig corner = around_room();
  corner.inside = {Point(-2.85, -1.85, -1.35)};
  map_from_mesh(soup(room), corner, "room", &report);
  ASSERT_TRUE(report.leak);
  EXPECT_NEAR((report.leak->narrowest - Point(3.0, 1.0, 0.5)).norm(), 0.0, 0.3);
}

TEST(MeshMap, WithoutSeedsTheLargerOfInsideAndOutsideIsFree) {
  const TriangleSoup box = soup(testing::box_mesh({0, 0, 0}, {6, 4, 3}));
  MeshMapReport report;
  const MeshMapConfig own{.voxel_size = 0.1, .bounds = {}, .inside = {}, .margin = 0};
  EXPECT_EQ(state_at(map_from_mesh(box, own, "box", &report), {0, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(report.free, MeshMapReport::Free::kWithin);
  MeshMapConfig wide = around_room();
  wide.inside.clear();
  const OccupancyMap around = map_from_mesh(box, wide, "box", &report);
  EXPECT_EQ(report.free, MeshMapReport::Free::kAround);
  EXPECT_EQ(report.enclosed, 1u);
  EXPECT_NEAR(report.largest_enclosed, 5.8 * 3.8 * 2.8, 0.1);
  EXPECT_EQ(state_at(around, {0, 0, 0}), VoxelState::kUnknown);
  EXPECT_EQ(state_at(around, {4, 0, 0}), VoxelState::kFree);
}

TEST(MeshMap, ASheetIsAThinWall) {
  TriangleSoup sheet{{{0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}}, {{0, 1, 2}, {0, 2, 3}}};
  const OccupancyMap map = map_from_mesh(
      sheet, {.voxel_size = 0.1, .bounds = Box{{-1, -1, -1}, {1, 1, 1}}, .inside = {}, .margin = 0},
      "sheet");
  EXPECT_EQ(state_at(map, {0.05, 0, 0}), VoxelState::kOccupied);
  EXPECT_EQ(state_at(map, {-0.05, 0, 0}), VoxelState::kOccupied);
  EXPECT_EQ(state_at(map, {0.15, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(state_at(map, {-0.15, 0, 0}), VoxelState::kFree);
}

TEST(MeshMap, RefusesWhatIsNoMeshAndPlacesThatAreNone) {
  const TriangleSoup box = soup(testing::box_mesh({0, 0, 0}, {2, 2, 2}));
  const MeshMapConfig own{.voxel_size = 0.1, .bounds = {}, .inside = {}, .margin = 0};
  const auto says = [&](const TriangleSoup& mesh, const MeshMapConfig& config) {
    return refusal([&] { map_from_mesh(mesh, config, "m.stl"); });
  };
  TriangleSoup bad = box;
  bad.vertices[0].x() = std::nan("");
  EXPECT_NE(says(bad, own).find("not finite"), std::string::npos);
  bad.vertices[0].x() = 1e30;
  EXPECT_NE(says(bad, own).find("beyond 1e9 voxels"), std::string::npos) << says(bad, own);
  bad = box;
  bad.triangles[3][1] = 99;
  EXPECT_NE(says(bad, own).find("vertex 99 of 8"), std::string::npos);
  EXPECT_NE(says({}, own).find("no triangles"), std::string::npos);
  MeshMapConfig seeded = own;
  seeded.inside = {{0.97, 0, 0}};
  EXPECT_NE(says(box, seeded).find("surface touches"), std::string::npos);
  seeded.inside = {{50, 0, 0}};
  EXPECT_NE(says(box, seeded).find("outside the bounds"), std::string::npos);
  EXPECT_NE(says(box, {.voxel_size = 5.0, .bounds = {}, .inside = {}, .margin = 0})
                .find("has no room for a voxel: it is 2 x 2 x 2 m (check its units"),
            std::string::npos);
}

TEST(MeshMap, AMillionTrianglesWithoutAreaTakeSeconds) {
  TriangleSoup mesh = soup(testing::box_mesh({0, 0, 0}, {6, 4, 3}));
  mesh.vertices.emplace_back(1, 1, 1);
  mesh.vertices.emplace_back(1, 1.5, 1);
  for (int i = 0; i < 1'000'000; ++i) mesh.triangles.push_back({8, i % 2 == 0 ? 8u : 9u, 9});
  const auto start = std::clock();
  const OccupancyMap map = map_from_mesh(mesh, around_room(), "mesh");
  EXPECT_EQ(state_at(map, {1.01, 1.2, 1.01}), VoxelState::kOccupied);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 60.0);
}

}  // namespace
}  // namespace ridgeway
