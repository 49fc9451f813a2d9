// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mapping/touched_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ridgeway/common/parallel.hpp"
#include "sensing/test_meshes.hpp"

namespace ridgeway {
namespace {

using Polygon = std::vector<Point>;

/// What of a polygon lies within a closed box: cut by one side after the other (Sutherland and
/// Hodgman 1974). Nothing but corners and crossings is looked at, no axis that separates.
bool meets_box(Polygon polygon, const Point& low, const Point& high) {
  for (int side = 0; side < 6 && !polygon.empty(); ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const double limit = side % 2 == 0 ? low[axis] : -high[axis];
    const auto depth = [&](const Point& p) { return sign * p[axis] - limit; };
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = depth(a), db = depth(b);
      if (da >= 0.0) kept.push_back(a);
      if ((da >= 0.0) != (db >= 0.0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    polygon = kept;
  }
  return !polygon.empty();
}

bool is_set(const BlockMasks& masks, const VoxelIndex& voxel) {
  const auto at = std::lower_bound(masks.blocks.begin(), masks.blocks.end(), block_of(voxel));
  if (at == masks.blocks.end() || *at != block_of(voxel)) return false;
  const int local = local_of(voxel);
  const auto block = static_cast<std::size_t>(at - masks.blocks.begin());
  return masks.voxels[block][static_cast<std::size_t>(local >> 6)] >> (local & 63) & 1;
}

VoxelTriangles moved(const testing::TriangleList& mesh, const Point& by, double scale) {
  VoxelTriangles all;
  for (const Point& v : mesh.vertices) all.vertices.emplace_back(v * scale + by);
  all.triangles = mesh.triangles;
  return all;
}

void expect_as_by_cutting(const VoxelTriangles& mesh, const VoxelIndex& size) {
  constexpr double kSlack = 1e-7;
  const BlockMasks masks = touched_voxels(mesh, size, "mesh");
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const Point low(x, y, z), high = low + Point::Ones(), slack = Point::Constant(kSlack);
        bool surely = false, perhaps = false;
        for (const auto& [a, b, c] : mesh.triangles) {
          const Polygon polygon = {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
          surely = surely || meets_box(polygon, low + slack, high - slack);
          perhaps = perhaps || meets_box(polygon, low - slack, high + slack);
        }
        const bool found = is_set(masks, {x, y, z});
        ASSERT_TRUE(found || !surely) << "missing " << x << ' ' << y << ' ' << z;
        ASSERT_TRUE(!found || perhaps) << "too many " << x << ' ' << y << ' ' << z;
      }
}

TEST(TouchedVoxels, AreThoseThatTrianglesMeetWhenCutToThem) {
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    expect_as_by_cutting(moved(testing::random_soup(seed, 12),
                               Point::Constant(10.0 + 0.37 * static_cast<double>(seed)), 1.3),
                         {19, 23, 17});
}

TEST(TouchedVoxels, OfTrianglesWithoutAreaAreThoseOfSegmentsAndPoints) {
  Random random(1, 1);
  VoxelTriangles mesh;
  for (std::uint32_t i = 0; i < 60; i += 3) {
    const Point a = testing::random_vector(random, 0.0, 16.0),
                b = testing::random_vector(random, 0.0, 16.0);
    mesh.vertices.insert(mesh.vertices.end(), {a, b, i % 2 == 0 ? a : Point(0.5 * (a + b))});
    mesh.triangles.push_back({i, i + 1, i + 2});
    mesh.triangles.push_back({i, i, i});
  }
  expect_as_by_cutting(mesh, {16, 16, 16});
}

TEST(TouchedVoxels, OnBothSidesOfAPlaneBetweenVoxels) {
  VoxelTriangles mesh{{{4, 1, 1}, {4, 6, 1}, {4, 1, 6}}, {{0, 1, 2}}, 0.0};
  const BlockMasks masks = touched_voxels(mesh, {9, 9, 9}, "mesh");
  EXPECT_TRUE(is_set(masks, {3, 2, 2}));
  EXPECT_TRUE(is_set(masks, {4, 2, 2}));
  EXPECT_FALSE(is_set(masks, {5, 2, 2}));
  EXPECT_FALSE(is_set(masks, {2, 2, 2}));
}

TEST(TouchedVoxels, AreTheSameForAnyNumberOfThreads) {
  const VoxelTriangles mesh = moved(testing::spiky_mesh(4), Point::Constant(60), 25.0);
  const auto with = [&](int threads) {
    return with_threads(threads, [&] { return touched_voxels(mesh, {120, 120, 120}, "mesh"); });
  };
  const BlockMasks one = with(1), two = with(2);
  EXPECT_EQ(one.blocks, two.blocks);
  EXPECT_EQ(one.voxels, two.voxels);
}

}  // namespace
}  // namespace ridgeway
