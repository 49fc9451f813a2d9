// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "common/random.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {
namespace {

constexpr double kVoxel = 0.1, kTruncation = 0.4;

using Distance = std::function<double(const Point&)>;

/// A distance field sampled over the blocks -reach .. reach - 1 on every axis, all of it known.
TsdfMap sample(const Distance& distance, int reach) {
  std::vector<BlockIndex> blocks;
  for (int z = -reach; z < reach; ++z)
    for (int y = -reach; y < reach; ++y)
      for (int x = -reach; x < reach; ++x) blocks.push_back({x, y, z});
  TsdfMap map{.voxel_size = kVoxel,
              .truncation = kTruncation,
              .layout = BlockLayout(std::move(blocks)),
              .distance = {},
              .weight = {}};
  map.distance = VoxelField<float>(map.layout);
  map.weight = VoxelField<float>(map.layout, 1.0f);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    const double value = distance(centre_of(map.layout.index_of(id), kVoxel));
    map.distance[id] = static_cast<float>(std::clamp(value, -kTruncation, kTruncation));
  }
  return map;
}

const Distance kSphere = [](const Point& p) { return (p - Point(0.03, 0.01, -0.02)).norm() - 1.0; };
const Distance kBox = [](const Point& p) {
  World world;
  world.boxes.push_back({{0.02, 0.01, 0.03}, {1.1, 1.5, 0.77}});
  return surface_distance(world, p).distance;
};
const Distance kTorus = [](const Point& p) {
  return std::hypot(p.head<2>().norm() - 0.9, p.z()) - 0.4;
};

struct Edges {
  std::size_t count = 0, borders = 0;
  bool orientable = true;  ///< no edge has two triangles on one side
};

Edges edges_of(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
  Edges edges;
  for (const auto& [side, triangles] : sides) {
    if (triangles != 1) edges.orientable = false;
    const bool has_other = sides.contains({side.second, side.first});
    edges.borders += has_other ? 0 : 1;
    edges.count += !has_other || side.first < side.second ? 1 : 0;
  }
  return edges;
}

std::size_t used_vertices(const SurfaceMesh& mesh) {
  std::set<std::uint32_t> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  return used.size();
}

long euler_characteristic(const SurfaceMesh& mesh) {
  return static_cast<long>(mesh.vertices.size()) - static_cast<long>(edges_of(mesh).count) +
         static_cast<long>(mesh.triangles.size());
}

Eigen::Vector3d area_of(const SurfaceMesh& mesh, const Triangle& t) {
  const Point& p = mesh.vertices[t[0]];
  return 0.5 * (mesh.vertices[t[1]] - p).cross(mesh.vertices[t[2]] - p);
}

double total_area(const SurfaceMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += area_of(mesh, t).norm();
  return area;
}

double volume_of(const SurfaceMesh& mesh) {
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles)
    volume += area_of(mesh, t).dot(mesh.vertices[t[0]]) / 3.0;
  return volume;
}

double farthest_off(const SurfaceMesh& mesh, const Distance& distance) {
  double farthest = 0.0;
  for (const Point& p : mesh.vertices) farthest = std::max(farthest, std::abs(distance(p)));
  return farthest;
}

void expect_closed(const SurfaceMesh& mesh, long euler) {
  const Edges edges = edges_of(mesh);
  EXPECT_TRUE(edges.orientable);
  EXPECT_EQ(edges.borders, 0u);
  EXPECT_EQ(used_vertices(mesh), mesh.vertices.size());
  EXPECT_EQ(euler_characteristic(mesh), euler);
}

TEST(SurfaceMesh, OfASphereIsASphere) {
  const SurfaceMesh mesh = surface_of(sample(kSphere, 2));
  expect_closed(mesh, 2);
  EXPECT_LT(farthest_off(mesh, kSphere), 0.04 * kVoxel);
  EXPECT_NEAR(total_area(mesh), 4.0 * std::numbers::pi, 0.01 * 4.0 * std::numbers::pi);
  EXPECT_NEAR(volume_of(mesh), 4.0 / 3.0 * std::numbers::pi, 0.01 * 4.0 / 3.0 * std::numbers::pi);
}

TEST(SurfaceMesh, OfABoxIsABoxWithBluntEdges) {
  const SurfaceMesh mesh = surface_of(sample(kBox, 2));
  expect_closed(mesh, 2);
  EXPECT_LT(farthest_off(mesh, kBox), 0.5 * kVoxel);
  const double area = 2.0 * (1.1 * 1.5 + 1.5 * 0.77 + 0.77 * 1.1);
  EXPECT_NEAR(total_area(mesh), area, 0.06 * area);
  EXPECT_NEAR(volume_of(mesh), 1.1 * 1.5 * 0.77, 0.02 * 1.1 * 1.5 * 0.77);
}

TEST(SurfaceMesh, OfATorusHasItsHole) { expect_closed(surface_of(sample(kTorus, 2)), 0); }

TEST(SurfaceMesh, NormalsPointIntoTheOpen) {
  for (const Distance& distance : {kSphere, kBox, kTorus}) {
    const SurfaceMesh mesh = surface_of(sample(distance, 2));
    ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      ASSERT_NEAR(mesh.normals[i].norm(), 1.0, 1e-9);
      ASSERT_GT(distance(mesh.vertices[i] + 0.1 * mesh.normals[i]), distance(mesh.vertices[i]));
    }
    for (const Triangle& t : mesh.triangles) {
      const Point middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
      const Eigen::Vector3d area = area_of(mesh, t);
      ASSERT_GT(area.norm(), 0.0);
      ASSERT_GT(distance(middle + 0.1 * area.normalized()), distance(middle));
    }
  }
}

/// Noise is the hardest shape there is.
TsdfMap random_tsdf(std::uint64_t seed, double known) {
  Random random(seed);
  TsdfMap map = sample([&](const Point&) { return random.uniform(-0.4, 0.4); }, 1);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
    if (random.uniform() >= known) map.weight[id] = 0.0f;
    if (random.below(10) == 0) map.distance[id] = 0.0f;
  }
  return map;
}

TEST(SurfaceMesh, NoiseTooIsAManifoldThatEndsAtTheUnknownAlone) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TsdfMap map = random_tsdf(seed, 1.0);
    for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) {
      const VoxelIndex v = map.layout.index_of(id);
      if (std::min({v.x, v.y, v.z}) == -8 || std::max({v.x, v.y, v.z}) == 7)
        map.distance[id] = 0.4f;  // so that nothing is cut off at the end of the map
    }
    const SurfaceMesh mesh = surface_of(map);
    const Edges edges = edges_of(mesh);
    EXPECT_GT(mesh.triangles.size(), 10000u);
    EXPECT_TRUE(edges.orientable);
    EXPECT_EQ(edges.borders, 0u);
    EXPECT_EQ(used_vertices(mesh), mesh.vertices.size());
  }
}

TEST(SurfaceMesh, NoTriangleTouchesTheUnknown) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const TsdfMap map = random_tsdf(seed, 0.9);
    const SurfaceMesh mesh = surface_of(map);
    EXPECT_GT(mesh.triangles.size(), 1000u);
    EXPECT_TRUE(edges_of(mesh).orientable);
    EXPECT_GT(edges_of(mesh).borders, 0u);
    EXPECT_EQ(used_vertices(mesh), mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
      // The cell that holds a triangle: its middle lies inside.
      const Point middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
      const VoxelIndex low = voxel_at(middle - Point::Constant(0.5 * kVoxel), kVoxel);
      for (int c = 0; c < 8; ++c) {
        const VoxelId id = map.layout.find(low + VoxelIndex{c & 1, c >> 1 & 1, c >> 2});
        ASSERT_NE(id, kNoVoxel);
        ASSERT_GT(map.weight[id], 0.0f);
      }
    }
  }
}

TEST(SurfaceMesh, TheSameForAnyNumberOfThreads) {
  const TsdfMap map = random_tsdf(7, 0.9);
  const SurfaceMesh one = with_threads(1, [&] { return surface_of(map); });
  const SurfaceMesh two = with_threads(2, [&] { return surface_of(map); });
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.normals, two.normals);
  EXPECT_EQ(one.triangles, two.triangles);
}

TEST(SurfaceMesh, OfNothingIsEmpty) {
  EXPECT_TRUE(surface_of(TsdfMap{}).triangles.empty());
  EXPECT_TRUE(surface_of(sample([](const Point&) { return 1.0; }, 1)).vertices.empty());
}

}  // namespace
}  // namespace ridgeway
