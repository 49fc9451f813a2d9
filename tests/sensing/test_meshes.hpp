// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "random_worlds.hpp"
#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway::testing {

struct TriangleList {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
};

/// Faces of two triangles each, fronts outwards.
inline TriangleList box_mesh(const Point& centre, const Eigen::Vector3d& size) {
  TriangleList mesh;
  for (int c = 0; c < 8; ++c) {
    const Eigen::Vector3d corner(c & 1, c >> 1 & 1, c >> 2);
    mesh.vertices.emplace_back(centre + size.cwiseProduct(corner - Point::Constant(0.5)));
  }
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned one = 1u << (axis + 1) % 3, other = 1u << (axis + 2) % 3, up = 1u << axis;
    mesh.triangles.push_back({up, up | one, up | one | other});
    mesh.triangles.push_back({up, up | one | other, up | other});
    mesh.triangles.push_back({0, one | other, one});
    mesh.triangles.push_back({0, other, one | other});
  }
  return mesh;
}

/// Adds a part to a mesh, its fronts where its backs were if it is turned.
inline void append(const TriangleList& part, bool is_turned, TriangleList& whole) {
  const auto first = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (auto [a, b, c] : part.triangles) {
    if (is_turned) std::swap(b, c);
    whole.triangles.push_back({first + a, first + b, first + c});
  }
}

/// An octahedron, its triangles cut into four and pushed out to the sphere again and again.
inline TriangleList sphere_mesh(double radius, int cuts) {
  TriangleList mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) mesh.vertices.emplace_back(side * Point::Unit(axis));
  for (std::uint32_t c = 0; c < 8; ++c) {
    const std::uint32_t x = c & 1, y = 2 + (c >> 1 & 1), z = 4 + (c >> 2);
    if ((x + (y & 1) + (z & 1)) % 2 == 0)
      mesh.triangles.push_back({x, y, z});
    else
      mesh.triangles.push_back({x, z, y});
  }
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] = middles.try_emplace(
          {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.emplace_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  for (Point& v : mesh.vertices) v *= radius;
  return mesh;
}

/// Triangles anywhere, of any size and any thinness; some share vertices.
inline TriangleList random_soup(std::uint64_t seed, std::size_t triangles) {
  Random random(seed, 5);
  TriangleList mesh;
  for (std::size_t i = 0; i < triangles; ++i) {
    const Point centre = random_vector(random, -5.0, 5.0);
    const double size = std::exp(random.uniform(-3.0, 1.0));
    Triangle triangle{};
    for (std::uint32_t& v : triangle) {
      if (!mesh.vertices.empty() && random.below(5) == 0) {
        v = static_cast<std::uint32_t>(random.below(mesh.vertices.size()));
      } else {
        v = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.emplace_back(centre + random_vector(random, -size, size));
      }
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// A closed surface with deep dents and sharp spikes.
inline TriangleList spiky_mesh(std::uint64_t seed) {
  TriangleList mesh = sphere_mesh(1.0, 2);
  Random random(seed, 3);
  for (Point& v : mesh.vertices) v *= random.uniform(0.2, 2.0);
  return mesh;
}

inline double segment_distance(const Point& p, const Point& a, const Point& b) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - (a + t * (b - a))).norm();
}

/// Every edge and every plane of every triangle.
inline double brute_distance(const TriangleList& mesh, const Point& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Point &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
    for (const double d :
         {segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)})
      nearest = std::min(nearest, d);
    Eigen::Matrix<double, 3, 2> sides;
    sides << b - a, c - a;
    const Eigen::Vector2d share = sides.colPivHouseholderQr().solve(p - a);
    if (share.minCoeff() >= 0.0 && share.sum() <= 1.0)
      nearest = std::min(nearest, (p - a - sides * share).norm());
  }
  return nearest;
}

}  // namespace ridgeway::testing
