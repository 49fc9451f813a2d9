// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/sensing/triangle_tree.hpp"

namespace ridgeway {

struct SurfaceDistance {
  double distance = 0.0;                                ///< metres, negative inside a solid
  Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();  ///< of length one, away from the surface
};

/// A surface of triangles, as part of a simulated world. Closed, it bounds a solid behind its
/// fronts (all fronts turned inwards: a cave, solid all around). Not closed, it is a thin sheet
/// with nothing inside. Immutable: safe to read from many threads.
class SolidMesh {
 public:
  /// Vertices at the same place count as one, triangles with the same corners too. Throws
  /// InputError for a vertex that is not finite, an index without a vertex, or where no triangle
  /// with three different corners is left.
  SolidMesh(const std::vector<Point>& vertices, const std::vector<Triangle>& triangles);

  /// Whether every edge has exactly two triangles, one on each side.
  bool is_closed() const { return !neighbours_.empty(); }
  std::size_t triangle_count() const { return tree_.triangles().size(); }
  const Point& low() const { return tree_.low(); }    ///< of the box around it
  const Point& high() const { return tree_.high(); }  ///< of the box around it

  /// Exact distance to the triangles: of a closed mesh negative inside, else never.
  SurfaceDistance distance(const Point& p) const;

  /// How far a ray along a direction of length one runs until it meets a triangle, from either
  /// side; 0 from inside a closed mesh, infinite where it meets none.
  double cast_ray(const Point& origin, const Eigen::Vector3d& direction) const;

 private:
  void find_neighbours();
  void find_normals();
  Eigen::Vector3d normal_at(const TriangleTree::Nearest& place) const;

  TriangleTree tree_;
  std::vector<Eigen::Vector3d> face_normals_;    ///< of length one; 0 for triangles without area
  std::vector<Eigen::Vector3d> vertex_normals_;  ///< any length
  std::vector<Triangle>
      neighbours_;  ///< across the edge from corner i to i + 1; none if not closed
};

}  // namespace ridgeway
