// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ridgeway/sensing/solid_mesh.hpp"
#include "test_meshes.hpp"

namespace ridgeway {
namespace {

using testing::box_mesh;
using testing::brute_distance;
using testing::random_direction;
using testing::random_soup;
using testing::random_vector;
using testing::spiky_mesh;
using testing::TriangleList;
using Vector = Eigen::Vector3d;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// Möller and Trumbore 1997, every triangle. Negative margins leave out what is near an edge.
double brute_ray(const TriangleList& mesh, const Point& origin, const Vector& direction,
                 double margin) {
  double first = kEverywhere;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    Eigen::Matrix3d sides;
    sides << mesh.vertices[ib] - mesh.vertices[ia], mesh.vertices[ic] - mesh.vertices[ia],
        -direction;
    const Vector at = sides.fullPivLu().solve(origin - mesh.vertices[ia]);
    if (!(sides * at).isApprox(origin - mesh.vertices[ia], 1e-9)) continue;
    if (at.x() >= -margin && at.y() >= -margin && at.x() + at.y() <= 1.0 + margin && at.z() >= 0.0)
      first = std::min(first, at.z());
  }
  return first;
}

TEST(TriangleTree, NearestPointIsTheNearestOfAllTriangles) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleList soup = random_soup(seed, 1 + 10 * seed);
    const TriangleTree tree(soup.vertices, soup.triangles);
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
      const Point p = random_vector(random, -8.0, 8.0);
      const auto nearest = tree.nearest(p);
      ASSERT_NEAR(std::sqrt(nearest.squared_distance), brute_distance(soup, p), 1e-9);
      ASSERT_NEAR((nearest.point - p).squaredNorm(), nearest.squared_distance, 1e-12);
      ASSERT_LT(brute_distance(soup, nearest.point), 1e-9);
    }
  }
}

TEST(TriangleTree, RaysMeetTheFirstOfAllTriangles) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleList soup = random_soup(seed, 1 + 10 * seed);
    const TriangleTree tree(soup.vertices, soup.triangles);
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
      const Point origin = random_vector(random, -8.0, 8.0);
      const Vector direction = i % 4 == 0 ? Vector(Vector::Unit(i / 4 % 3) * (i % 8 == 0 ? 1 : -1))
                                          : random_direction(random);
      const double range = tree.first_hit(origin, direction).range;
      const double expected = brute_ray(soup, origin, direction, 0.0);
      if (brute_ray(soup, origin, direction, 1e-9) != brute_ray(soup, origin, direction, -1e-9))
        continue;  // an edge, where rounding decides
      ASSERT_EQ(std::isinf(range), std::isinf(expected));
      if (std::isinf(range)) continue;
      ASSERT_NEAR(range, expected, 1e-8);
      ++met;
    }
  }
  EXPECT_GT(met, 200);
}

TEST(TriangleTree, NoRaySlipsThroughAnEdgeOrAVertex) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    TriangleList mesh = seed % 2 == 0 ? box_mesh(Point::Zero(), {2.0, 1.0, 3.0}) : spiky_mesh(seed);
    // From on the grid, where much is exact, to where every bit is rounded.
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(seed < 4 ? 0.0 : random.uniform(0.0, 6.0), random_direction(random))
            .toRotationMatrix();
    const double far = std::pow(10.0, static_cast<double>(seed % 5));
    const Vector shift = seed < 4 ? Vector::Zero() : random_vector(random, -far, far);
    for (Point& v : mesh.vertices) v = turn * v + shift;
    const TriangleTree tree(mesh.vertices, mesh.triangles);
    for (int i = 0; i < 2000; ++i) {
      const Triangle& t = mesh.triangles[random.below(mesh.triangles.size())];
      const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]];
      const double share = i % 2 == 0 ? 0.0 : random.uniform();
      const Point target = a + share * (b - a);
      const Point centre = shift + turn * random_vector(random, -0.05, 0.05);  // inside
      const Point inside = seed < 4 && i % 4 < 2 ? Point::Zero() : centre;
      const Vector direction = (target - inside).normalized();
      // Out of the solid through an edge, and from behind it in through the same one.
      ASSERT_LE(tree.first_hit(inside, direction).range, (target - inside).norm() + 1e-9 * far);
      const double back = (target - inside).norm() + 10.0 * far;
      ASSERT_LE(tree.first_hit(inside + back * direction, -direction).range, back + 1e-9 * far);
    }
  }
}

}  // namespace
}  // namespace ridgeway
