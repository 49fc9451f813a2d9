// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// The three vertices of a mesh that a triangle joins, counter-clockwise seen from its front.
using Triangle = std::array<std::uint32_t, 3>;

/// A tree of boxes around triangles: finds the nearest point of them and where a ray meets them,
/// without looking at most. Immutable after construction: safe to read from many threads.
class TriangleTree {
 public:
  /// Takes at least one triangle; its vertices must be there and finite. The triangles are put into
  /// the tree's own order.
  TriangleTree(std::vector<Point> vertices, std::vector<Triangle> triangles);

  /// As they were given, by the numbers that triangles() has.
  std::span<const Point> vertices() const { return vertices_; }
  /// In the tree's own order.
  std::span<const Triangle> triangles() const { return triangles_; }
  const Point& low() const { return nodes_.front().low; }    ///< of the box around all
  const Point& high() const { return nodes_.front().high; }  ///< of the box around all

  /// The place of a triangle that is nearest to a point.
  struct Nearest {
    Point point = Point::Zero();                                        ///< on the triangle
    double squared_distance = std::numeric_limits<double>::infinity();  ///< to there
    std::uint32_t triangle = 0;  ///< its place in triangles()
    /// Bit i: corner i takes part. One corner is the point itself, two are the ends of the edge
    /// that it lies on, all three stand for the triangle's inside.
    unsigned corners = 0;
  };
  /// The point of the triangles nearest to another, to rounding.
  Nearest nearest(const Point& p) const;

  /// A place on a triangle that a ray meets.
  struct Hit {
    /// along the ray, of a direction of length one
    double range = std::numeric_limits<double>::infinity();
    /// its place in triangles(); of no meaning where the range is infinite
    std::uint32_t triangle = 0;
  };
  /// Where a ray along a direction of length one first meets a triangle, from either side; infinite
  /// if nowhere. No ray slips through between triangles that share an edge or a vertex.
  Hit first_hit(const Point& origin, const Eigen::Vector3d& direction) const;

  /// How many more triangles a ray meets from the back than from the front: where they are closed,
  /// the winding number around its origin. Nothing where it runs so near to an edge or a vertex
  /// that rounding decides. The origin lies on no triangle.
  std::optional<int> winding_along(const Point& origin, const Eigen::Vector3d& direction) const;

 private:
  /// The first child of an inner node follows it.
  struct Node {
    Point low, high;
    std::uint32_t count = 0;  ///< triangles of a leaf; 0 for an inner node
    std::uint32_t first = 0;  ///< a leaf's first triangle, an inner node's second child
  };
  struct Builder;

  std::vector<Point> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

/// How far a surface is, and in which direction away from it.
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
  /// Triangles that are left when those without area and doubles are gone.
  std::size_t triangle_count() const { return tree_.triangles().size(); }
  const Point& low() const { return tree_.low(); }    ///< of the box around it
  const Point& high() const { return tree_.high(); }  ///< of the box around it
  const TriangleTree& tree() const { return tree_; }  ///< of all triangles that are left

  /// Exact distance to the triangles: of a closed mesh negative inside, else never.
  SurfaceDistance distance(const Point& p) const;

  /// Whether a point that is not on the surface lies in the solid, by the winding number around it:
  /// of a mesh that encloses a volume where that is not 0, of a cave where it is not negative. The
  /// same as the sign of the distance but where the mesh cuts through itself, parts of it lie
  /// within others with their fronts turned alike, or beside others with theirs turned the other
  /// way: all that they enclose is solid. Never where it is not closed.
  bool encloses(const Point& p) const;

  /// How far a ray along a direction of length one runs until it meets a triangle, from either
  /// side; 0 from inside a closed mesh, infinite where it meets none.
  double cast_ray(const Point& origin, const Eigen::Vector3d& direction) const;

 private:
  void find_neighbours();
  void find_normals();
  double signed_volume() const;
  Eigen::Vector3d normal_at(const TriangleTree::Nearest& place) const;

  TriangleTree tree_;
  std::vector<Eigen::Vector3d> face_normals_;    ///< of length one; 0 for triangles without area
  std::vector<Eigen::Vector3d> vertex_normals_;  ///< any length
  std::vector<Triangle>
      neighbours_;        ///< across the edge from corner i to i + 1; none if not closed
  bool is_cave_ = false;  ///< closed, with fronts turned inwards
};

}  // namespace ridgeway
