// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/solid_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;

void validate(const std::vector<Point>& vertices, const std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!vertices[i].allFinite())
      throw InputError("mesh", "has a vertex, number " + std::to_string(i) + ", that is not finite",
                       "repair it, or write it again");
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t v : triangles[i])
      if (v >= vertices.size())
        throw InputError("mesh",
                         "has a triangle, number " + std::to_string(i) + ", of vertex " +
                             std::to_string(v) + " of " + std::to_string(vertices.size()),
                         "repair it, or write it again");
}

/// For every vertex the first one at the same place.
std::vector<std::uint32_t> find_same(const std::vector<Point>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), same(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Point &p = vertices[a], &q = vertices[b];
    return std::tuple(p.x(), p.y(), p.z(), a) < std::tuple(q.x(), q.y(), q.z(), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    same[order[i]] =
        i > 0 && vertices[order[i]] == vertices[order[i - 1]] ? same[order[i - 1]] : order[i];
  return same;
}

/// Leaves out triangles without three different corners, and all but the first with the same ones.
std::vector<Triangle> without_doubles(std::vector<Triangle> triangles) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Triangle corners = triangles[i];
    std::sort(corners.begin(), corners.end());
    if (corners[0] != corners[1] && corners[1] != corners[2]) sorted.emplace_back(corners, i);
  }
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end(),
                           [](const auto& a, const auto& b) { return a.first == b.first; }),
               sorted.end());
  std::vector<Triangle> kept;
  kept.reserve(sorted.size());
  for (const auto& [corners, triangle] : sorted) kept.push_back(triangles[triangle]);
  return kept;
}

TriangleTree tree_of(const std::vector<Point>& vertices, std::vector<Triangle> triangles) {
  validate(vertices, triangles);
  const std::vector<std::uint32_t> same = find_same(vertices);
  for (Triangle& triangle : triangles)
    for (std::uint32_t& v : triangle) v = same[v];
  triangles = without_doubles(std::move(triangles));
  if (triangles.empty())
    throw InputError("mesh", "has no triangle with three different corners",
                     "give one with a surface");
  return {vertices, std::move(triangles)};
}

}  // namespace

SolidMesh::SolidMesh(const std::vector<Point>& vertices, const std::vector<Triangle>& triangles)
    : tree_(tree_of(vertices, triangles)) {
  find_neighbours();
  find_normals();
  is_cave_ = is_closed() && signed_volume() < 0.0;
}

void SolidMesh::find_neighbours() {
  struct Side {
    std::uint32_t low, high, triangle, corner;
    bool up;  ///< runs from low to high
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangle_count());
  for (std::uint32_t t = 0; t < triangle_count(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t from = tree_.triangles()[t][i], to = tree_.triangles()[t][(i + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, i, from < to});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple(a.low, a.high, a.triangle) < std::tuple(b.low, b.high, b.triangle);
  });
  const auto same_edge = [&](std::size_t i, std::size_t k) {
    return sides[i].low == sides[k].low && sides[i].high == sides[k].high;
  };
  std::vector<Triangle> neighbours(triangle_count());
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    const bool is_pair = i + 1 < sides.size() && same_edge(i, i + 1) &&
                         sides[i].up != sides[i + 1].up &&
                         (i + 2 == sides.size() || !same_edge(i, i + 2));
    if (!is_pair) return;
    neighbours[sides[i].triangle][sides[i].corner] = sides[i + 1].triangle;
    neighbours[sides[i + 1].triangle][sides[i + 1].corner] = sides[i].triangle;
  }
  neighbours_ = std::move(neighbours);
}

/// A vertex takes the normals of its triangles, each as often as its angle there is wide: then the
/// sign is right wherever the vertex is the nearest place (Baerentzen and Aanaes 2005).
void SolidMesh::find_normals() {
  vertex_normals_.assign(tree_.vertices().size(), Vector::Zero());
  face_normals_.reserve(triangle_count());
  for (const Triangle& triangle : tree_.triangles()) {
    const auto corner = [&](std::size_t i) -> const Point& {
      return tree_.vertices()[triangle[i % 3]];
    };
    const Vector normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    face_normals_.push_back(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector one = corner(i + 1) - corner(i), other = corner(i + 2) - corner(i);
      vertex_normals_[triangle[i]] += std::atan2(one.cross(other).norm(), one.dot(other)) * normal;
    }
  }
}

/// Of the tetrahedra between each triangle and a corner of the box around all.
double SolidMesh::signed_volume() const {
  double sum = 0.0;
  for (const auto& [a, b, c] : tree_.triangles()) {
    const auto from_low = [&](std::uint32_t v) -> Vector { return tree_.vertices()[v] - low(); };
    sum += from_low(a).dot(from_low(b).cross(from_low(c)));
  }
  return sum / 6.0;
}

Vector SolidMesh::normal_at(const TriangleTree::Nearest& place) const {
  const Vector& face = face_normals_[place.triangle];
  switch (place.corners) {
    case 1:
      return vertex_normals_[tree_.triangles()[place.triangle][0]];
    case 2:
      return vertex_normals_[tree_.triangles()[place.triangle][1]];
    case 4:
      return vertex_normals_[tree_.triangles()[place.triangle][2]];
    case 7:
      return face;
    default: {
      if (!is_closed()) return face;
      const std::size_t edge = place.corners == 3 ? 0 : place.corners == 6 ? 1 : 2;
      return face + face_normals_[neighbours_[place.triangle][edge]];
    }
  }
}

SurfaceDistance SolidMesh::distance(const Point& p) const {
  const TriangleTree::Nearest nearest = tree_.nearest(p);
  const Vector normal = normal_at(nearest), away = p - nearest.point;
  const double distance = away.norm();
  if (distance == 0.0) return {0.0, normal.norm() > 0.0 ? normal.normalized() : Vector::UnitZ()};
  const double sign = is_closed() && normal.dot(away) < 0.0 ? -1.0 : 1.0;
  return {sign * distance, away * (sign / distance)};
}

bool SolidMesh::encloses(const Point& p) const {
  if (!is_closed()) return false;
  if ((p.array() < low().array()).any() || (p.array() > high().array()).any()) return is_cave_;
  constexpr int kRays = 32;  // one nearly always does
  constexpr double kGoldenAngle = 2.399963229728653;
  for (int i = 0; i < kRays; ++i) {
    const double z = (2.0 * i + 1.0) / kRays - 1.0, around = std::sqrt(1.0 - z * z);
    const double angle = kGoldenAngle * (i + 0.5);
    const Vector direction(around * std::cos(angle), around * std::sin(angle), z);
    if (const std::optional<int> winding = tree_.winding_along(p, direction))
      return is_cave_ ? *winding >= 0 : *winding != 0;
  }
  return distance(p).distance < 0.0;
}

double SolidMesh::cast_ray(const Point& origin, const Vector& direction) const {
  const TriangleTree::Hit hit = tree_.first_hit(origin, direction);
  // All around a cave is rock, without an end.
  if (is_cave_ && !std::isfinite(hit.range) && distance(origin).distance < 0.0) return 0.0;
  // The back of a closed surface is seen from inside alone; edges between the two are doubtful.
  const bool from_inside = is_closed() && std::isfinite(hit.range) &&
                           face_normals_[hit.triangle].dot(direction) > 0.0 &&
                           distance(origin).distance < 0.0;
  return from_inside ? 0.0 : hit.range;
}

}  // namespace ridgeway
