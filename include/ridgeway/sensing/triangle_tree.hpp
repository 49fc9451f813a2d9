// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "ridgeway/common/triangle.hpp"
#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// A tree of boxes around triangles: finds the nearest point of them and where a ray meets them,
/// without looking at most. Immutable after construction: safe to read from many threads.
class TriangleTree {
 public:
  /// Takes at least one triangle; its vertices must be there and finite. The triangles are put into
  /// the tree's own order.
  TriangleTree(std::vector<Point> vertices, std::vector<Triangle> triangles);

  std::span<const Point> vertices() const { return vertices_; }
  std::span<const Triangle> triangles() const { return triangles_; }
  const Point& low() const { return nodes_.front().low; }    ///< of the box around all
  const Point& high() const { return nodes_.front().high; }  ///< of the box around all

  struct Nearest {
    Point point = Point::Zero();
    double squared_distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
    /// Bit i: corner i takes part. One corner is the point itself, two are the ends of the edge
    /// that it lies on, all three stand for the triangle's inside.
    unsigned corners = 0;
  };
  /// The point of the triangles nearest to another, to rounding.
  Nearest nearest(const Point& p) const;

  struct Hit {
    double range = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
  };
  /// Where a ray along a direction of length one first meets a triangle, from either side; infinite
  /// if nowhere. No ray slips through between triangles that share an edge or a vertex.
  Hit first_hit(const Point& origin, const Eigen::Vector3d& direction) const;

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

}  // namespace ridgeway
