// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/solid_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ridgeway/common/error.hpp"
#include "ridgeway/sensing/world.hpp"
#include "sensing/poses.hpp"
#include "test_meshes.hpp"

namespace ridgeway {
namespace {

using testing::append;
using testing::box_mesh;
using testing::brute_distance;
using testing::random_direction;
using testing::random_vector;
using testing::sphere_mesh;
using testing::spiky_mesh;
using testing::TriangleList;
using Vector = Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SolidMesh solid(const TriangleList& mesh) { return {mesh.vertices, mesh.triangles}; }

/// How often a closed surface goes around a point (Van Oosterom and Strackee 1983): 1 inside.
double winding_number(const TriangleList& mesh, const Point& p) {
  double angle = 0.0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Vector a = mesh.vertices[ia] - p, b = mesh.vertices[ib] - p, c = mesh.vertices[ic] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

TEST(SolidMesh, BoxIsTheBox) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    World analytic;
    analytic.boxes.push_back({random_vector(random, -2.0, 2.0), random_vector(random, 0.2, 3.0)});
    const SolidMesh mesh = solid(box_mesh(analytic.boxes[0].centre, analytic.boxes[0].size));
    EXPECT_TRUE(mesh.is_closed());
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
      const Point p = i % 2 == 0 ? random_vector(random, -5.0, 5.0)
                                 : Point(analytic.boxes[0].centre + random_vector(random, -1., 1.));
      const SurfaceDistance expected = surface_distance(analytic, p), here = mesh.distance(p);
      inside += expected.distance < 0.0 ? 1 : 0;
      ASSERT_NEAR(here.distance, expected.distance, 1e-12);
      ASSERT_LT((here.gradient - expected.gradient).norm(), 1e-9);
      const Vector direction = random_direction(random);
      const double range = mesh.cast_ray(p, direction), truth = cast_ray(analytic, p, direction);
      ASSERT_EQ(std::isinf(range), std::isinf(truth));
      if (std::isfinite(range)) {
        ASSERT_NEAR(range, truth, 1e-9);
      }
    }
    EXPECT_GT(inside, 0);
  }
}

TEST(SolidMesh, SphereIsTheSphereLessItsChords) {
  World analytic;
  analytic.spheres.push_back({Point::Zero(), 2.0});
  const TriangleList list = sphere_mesh(2.0, 4);
  const SolidMesh mesh = solid(list);
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_EQ(mesh.triangle_count(), 2048u);
  double chord = 0.0;  // how far the middle of a triangle lies below the sphere
  for (const auto& [a, b, c] : list.triangles)
    chord = std::max(chord,
                     2.0 - ((list.vertices[a] + list.vertices[b] + list.vertices[c]) / 3.0).norm());
  EXPECT_LT(chord, 0.015);
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const Point p = random_vector(random, -4.0, 4.0);
    const double off = mesh.distance(p).distance - surface_distance(analytic, p).distance;
    ASSERT_GE(off, -1e-12);
    ASSERT_LE(off, chord + 1e-12);
    const Vector direction = (random_vector(random, -1.0, 1.0) - p).normalized();
    const double range = mesh.cast_ray(p, direction), truth = cast_ray(analytic, p, direction);
    ASSERT_GE(range, truth - 1e-9);
    ASSERT_LE(range, truth + 2.0 * chord);  // met at no more than 60 degrees from upright
  }
}

TEST(SolidMesh, SignIsThatOfTheWindingNumber) {
  int inside = 0, edges = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleList list = spiky_mesh(seed);
    const SolidMesh mesh = solid(list);
    ASSERT_TRUE(mesh.is_closed());
    const TriangleTree tree(list.vertices, list.triangles);
    Random random(seed);
    for (int i = 0; i < 300; ++i) {
      const Point p = random_vector(random, -1.5, 1.5);
      const SurfaceDistance here = mesh.distance(p);
      if (std::abs(here.distance) < 1e-6) continue;
      const bool is_inside = winding_number(list, p) > 0.5;
      ASSERT_EQ(here.distance < 0.0, is_inside);
      ASSERT_NEAR(here.gradient.norm(), 1.0, 1e-12);
      ASSERT_NEAR(brute_distance(list, p - here.distance * here.gradient), 0.0, 1e-9);
      const double range = mesh.cast_ray(p, random_direction(random));
      ASSERT_EQ(range == 0.0, is_inside);
      ASSERT_EQ(mesh.encloses(p), is_inside);
      inside += is_inside ? 1 : 0;
      edges += tree.nearest(p).corners != 7 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(edges, 2000);
}

/// Boxes, of which some overlap, some lie in others, and some are turned: rays along axes run
/// through edges, corners and faces, as points lie on a lattice of which all corners are.
TEST(SolidMesh, EnclosesWhatItGoesAround) {
  int enclosed = 0, doubtful = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Random random(seed, 9);
    TriangleList list;
    const bool is_cave = seed % 4 == 3;
    if (is_cave) append(box_mesh({3.0, 3.0, 3.0}, {10.0, 10.0, 10.0}), true, list);
    for (int i = 0; i < 4; ++i) {
      const auto below = [&](std::uint64_t n) { return static_cast<double>(random.below(n)); };
      const Point low(below(4), below(4), below(4));
      const Vector size(1.0 + below(3), 1.0 + below(3), 1.0 + below(3));
      append(box_mesh(low + 0.5 * size, size), seed % 4 == 2 && i == 3, list);
    }
    const SolidMesh mesh = solid(list);
    if (!mesh.is_closed()) continue;  // two of the boxes share an edge
    for (int i = 0; i < 8 * 8 * 8; ++i) {
      const int y = i / 8 % 8, z = i / 64;
      const Point p(i % 8 - 0.5, y - 0.5, z - 0.5);
      const auto winding = static_cast<int>(std::lround(winding_number(list, p)));
      const bool expected = is_cave ? winding >= 0 : winding != 0;
      ASSERT_EQ(mesh.encloses(p), expected) << seed << ": " << p.transpose();
      enclosed += expected;
      for (int axis = 0; axis < 3; ++axis) {
        const auto along = mesh.tree().winding_along(p, Vector::Unit(axis));
        ASSERT_EQ(along.value_or(winding), winding) << seed << ": " << p.transpose();
        doubtful += !along;
      }
    }
  }
  EXPECT_GT(enclosed, 1000);
  EXPECT_GT(doubtful, 100);
}

TEST(SolidMesh, TurnedInsideOutItIsACave) {
  TriangleList list = sphere_mesh(2.0, 2);
  for (Triangle& t : list.triangles) std::swap(t[1], t[2]);
  const SolidMesh cave = solid(list);
  EXPECT_TRUE(cave.is_closed());
  EXPECT_GT(cave.distance({0.5, 0.0, 0.0}).distance, 1.0);
  EXPECT_LT(cave.distance({3.0, 0.0, 0.0}).distance, -0.9);
  EXPECT_GT(cave.cast_ray(Point::Zero(), Vector::UnitX()), 1.5);
  EXPECT_EQ(cave.cast_ray({3.0, 0.1, 0.0}, -Vector::UnitX()), 0.0);
  EXPECT_EQ(cave.cast_ray({3.0, 0.1, 0.0}, Vector::UnitX()), 0.0);  // all rock
}

TEST(SolidMesh, NotClosedItIsAThinSheet) {
  TriangleList list = box_mesh(Point::Zero(), {2.0, 2.0, 2.0});
  list.triangles.pop_back();
  const SolidMesh mesh = solid(list);
  EXPECT_FALSE(mesh.is_closed());
  EXPECT_NEAR(mesh.distance({0.9, 0.0, 0.0}).distance, 0.1, 1e-12);
  EXPECT_NEAR(mesh.distance({1.1, 0.0, 0.0}).distance, 0.1, 1e-12);
  EXPECT_LT((mesh.distance({0.9, 0.0, 0.0}).gradient + Vector::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(mesh.cast_ray({0.5, 0.0, 0.0}, Vector::UnitX()), 0.5, 1e-12);
  EXPECT_NEAR(mesh.cast_ray({2.5, 0.0, 0.0}, -Vector::UnitX()), 1.5, 1e-12);
  Random random(3);
  for (int i = 0; i < 1000; ++i)
    ASSERT_GE(mesh.distance(random_vector(random, -2.0, 2.0)).distance, 0.0);
  // Where two solids share an edge, and where a triangle has a back of its own.
  TriangleList two = box_mesh(Point::Zero(), {2.0, 2.0, 2.0});
  const TriangleList other = box_mesh({2.0, 2.0, 0.0}, {2.0, 2.0, 2.0});
  for (const Triangle& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  EXPECT_FALSE(solid(two).is_closed());
  const SolidMesh leaf({Point::Zero(), Point::UnitX(), Point::UnitY()}, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_FALSE(leaf.is_closed());
  EXPECT_EQ(leaf.triangle_count(), 1u);
}

TEST(SolidMesh, VerticesAtOnePlaceAreOne) {
  const TriangleList shared = box_mesh(Point::Zero(), {2.0, 2.0, 2.0});
  TriangleList apart;
  for (const Triangle& t : shared.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.vertices.size());
    for (const std::uint32_t v : t) apart.vertices.push_back(shared.vertices[v]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  apart.triangles.push_back({0, 0, 1});
  apart.triangles.push_back({1, 2, 0});  // the first one once more
  const SolidMesh mesh = solid(apart);
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_EQ(mesh.triangle_count(), 12u);
  EXPECT_NEAR(mesh.distance({0.9, 0.0, 0.0}).distance, -0.1, 1e-12);
}

TEST(SolidMesh, WhatIsNoMeshIsRefused) {
  const TriangleList box = box_mesh(Point::Zero(), {1.0, 1.0, 1.0});
  const auto refused = [&](const auto& spoil) {
    TriangleList bad = box;
    spoil(bad);
    EXPECT_THROW(solid(bad), InputError);
  };
  refused([](TriangleList& m) { m.vertices[3].y() = std::nan(""); });
  refused([](TriangleList& m) { m.vertices[3].z() = kInfinity; });
  refused([](TriangleList& m) { m.triangles[5][1] = 8; });
  refused([](TriangleList& m) { m.triangles.clear(); });
  refused([](TriangleList& m) { m.triangles.assign(4, {1, 2, 1}); });
}

TEST(World, MeshesStandWhereTheyArePut) {
  const double yaw = 0.7;
  World world;
  PlacedMesh placed{std::make_shared<SolidMesh>(solid(box_mesh({0.5, 0.0, 0.0}, {1.0, 2.0, 3.0})))};
  placed.scale = 2.0;
  placed.T_world_mesh =
      Eigen::Translation3d(3.0, -1.0, 0.5) * Eigen::AngleAxisd(yaw, Vector::UnitZ());
  world.meshes.push_back(placed);
  EXPECT_NO_THROW(validate_world(world));
  World straight;  // the same box, seen from a frame turned with it
  straight.boxes.push_back({{1.0, 0.0, 0.0}, {2.0, 4.0, 6.0}});
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Point p = random_vector(random, -6.0, 6.0);
    const Vector direction = random_direction(random);
    const Point q = placed.T_world_mesh.inverse() * p;
    const SurfaceDistance here = surface_distance(world, p), there = surface_distance(straight, q);
    ASSERT_NEAR(here.distance, there.distance, 1e-12);
    ASSERT_LT((here.gradient - placed.T_world_mesh.linear() * there.gradient).norm(), 1e-9);
    const double range = cast_ray(world, p, direction);
    const double truth =
        cast_ray(straight, q, placed.T_world_mesh.linear().transpose() * direction);
    ASSERT_EQ(std::isinf(range), std::isinf(truth));
    if (std::isfinite(range)) {
      ASSERT_NEAR(range, truth, 1e-9);
    }
  }
  const PoseSampling volume = sampling_inside(world);
  EXPECT_NEAR(volume.low.z(), -2.5, 1e-12);
  EXPECT_NEAR(volume.high.x(), 3.0 + 2.0 * std::cos(yaw) + 2.0 * std::sin(yaw), 1e-12);

  const auto refused = [&](const auto& spoil) {
    World bad = world;
    spoil(bad.meshes[0]);
    EXPECT_THROW(validate_world(bad), InputError);
  };
  refused([](PlacedMesh& m) { m.mesh = nullptr; });
  refused([](PlacedMesh& m) { m.scale = 0.0; });
  refused([](PlacedMesh& m) { m.T_world_mesh.translation().x() = std::nan(""); });
  refused([](PlacedMesh& m) { m.T_world_mesh.linear() *= 2.0; });
}

}  // namespace
}  // namespace ridgeway
