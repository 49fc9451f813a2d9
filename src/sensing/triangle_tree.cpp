// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "ridgeway/sensing/solid_mesh.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kLeafTriangles = 4;

// --- the nearest point
// ----------------------------------------------------------------------------

struct Foot {
  Point point;
  unsigned corners;
};

Foot nearest_on_edge(const Point& p, const Point& a, const Point& b, unsigned bit_a,
                     unsigned bit_b) {
  const Vector along = b - a;
  const double part = along.dot(p - a), whole = along.squaredNorm();
  if (part <= 0.0) return {a, bit_a};
  if (part >= whole) return {b, bit_b};
  return {a + along * (part / whole), bit_a | bit_b};
}

Foot nearest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  constexpr double kThin = 1e-24;  // the normal of a thinner one is but rounding errors
  const Vector ab = b - a, ca = a - c, normal = ab.cross(-ca);
  const auto is_over = [&](const Point& corner, const Vector& edge) {
    return normal.cross(edge).dot(p - corner) > 0.0;
  };
  if (normal.squaredNorm() > kThin * ab.squaredNorm() * ca.squaredNorm() && is_over(a, ab) &&
      is_over(b, c - b) && is_over(c, ca))
    return {p - normal * (normal.dot(p - a) / normal.squaredNorm()), 7};
  Foot nearest = nearest_on_edge(p, a, b, 1, 2);
  for (const Foot& foot : {nearest_on_edge(p, b, c, 2, 4), nearest_on_edge(p, c, a, 4, 1)})
    if ((foot.point - p).squaredNorm() < (nearest.point - p).squaredNorm()) nearest = foot;
  return nearest;
}

double squared_distance_to_box(const Point& p, const Point& low, const Point& high) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

// --- rays
// -----------------------------------------------------------------------------------------

/// A ray made the third axis by a shear, the same for every triangle, so that a shared edge is seen
/// by both its triangles as the very same numbers (Woop, Benthin and Wald 2013).
class ShearedRay {
 public:
  ShearedRay(const Point& origin, const Vector& direction) : origin_(origin) {
    direction.cwiseAbs().maxCoeff(&along_);
    one_ = (along_ + 1) % 3;
    two_ = (along_ + 2) % 3;
    slope_one_ = direction[one_] / direction[along_];
    slope_two_ = direction[two_] / direction[along_];
    per_length_ = 1.0 / direction[along_];
  }

  /// Range at which it meets a triangle, edges and corners included; infinite if it does not. A
  /// product of differences may round to 0 but never to the wrong sign, so nothing slips through.
  double meets(const Point& p, const Point& q, const Point& r) const {
    const Vector a = sheared(p - origin_), b = sheared(q - origin_), c = sheared(r - origin_);
    const double u = c.x() * b.y() - c.y() * b.x();
    const double v = a.x() * c.y() - a.y() * c.x();
    const double w = b.x() * a.y() - b.y() * a.x();
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return kInfinity;
    const double sum = u + v + w;
    if (sum == 0.0) return kInfinity;  // seen from its edge: its neighbours are met
    const double range = (u * a.z() + v * b.z() + w * c.z()) / sum;
    return range >= 0.0 ? range : kInfinity;
  }

  /// 1 where it meets a triangle's back, -1 for its front, 0 where it misses; nothing where
  /// rounding decides.
  std::optional<int> side_met(const Point& p, const Point& q, const Point& r) const {
    const Vector from_p = p - origin_, from_q = q - origin_, from_r = r - origin_;
    const Vector a = sheared(from_p), b = sheared(from_q), c = sheared(from_r);
    const double reach = std::max({from_p.lpNorm<1>(), from_q.lpNorm<1>(), from_r.lpNorm<1>()});
    const double off = 64.0 * std::numeric_limits<double>::epsilon() * reach;
    const auto turn = [&](const Vector& one, const Vector& other) {
      const double product = one.x() * other.y() - one.y() * other.x();
      const double doubt = off * (one.head<2>().lpNorm<1>() + other.head<2>().lpNorm<1>() + off);
      return std::abs(product) <= doubt ? 0 : product > 0.0 ? 1 : -1;
    };
    const int u = turn(b, c), v = turn(c, a), w = turn(a, b);
    if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return 0;
    if (u == 0 || v == 0 || w == 0) return std::nullopt;
    if (!(meets(p, q, r) < kInfinity)) return 0;
    return per_length_ > 0.0 ? u : -u;
  }

 private:
  Vector sheared(const Vector& from) const {
    return {from[one_] - slope_one_ * from[along_], from[two_] - slope_two_ * from[along_],
            per_length_ * from[along_]};
  }

  Point origin_;
  Eigen::Index along_ = 0, one_ = 0, two_ = 0;
  double slope_one_ = 0.0, slope_two_ = 0.0, per_length_ = 0.0;
};

/// Where a ray enters boxes, each made larger by what the test of a triangle may be off.
class BoxEntry {
 public:
  BoxEntry(const Point& origin, const Vector& direction, const Point& low, const Point& high)
      : origin_(origin), per_length_(direction.cwiseInverse()) {
    const double reach = (low - origin).cwiseAbs().cwiseMax((high - origin).cwiseAbs()).maxCoeff();
    margin_ = 16.0 * std::numeric_limits<double>::epsilon() * reach;
  }

  /// Infinite if it misses the box.
  double range(const Point& low, const Point& high) const {
    double enters = 0.0, leaves = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double to_low = low[axis] - origin_[axis] - margin_;
      const double to_high = high[axis] - origin_[axis] + margin_;
      if (!std::isfinite(per_length_[axis])) {  // it runs beside this axis
        if (to_low > 0.0 || to_high < 0.0) return kInfinity;
        continue;
      }
      const double one = to_low * per_length_[axis], other = to_high * per_length_[axis];
      enters = std::max(enters, std::min(one, other));
      leaves = std::min(leaves, std::max(one, other));
    }
    return enters <= leaves ? enters : kInfinity;
  }

 private:
  Point origin_;
  Vector per_length_;
  double margin_ = 0.0;
};

/// Walks down a tree, nearer children first, where `bound(node)` is at most what any triangle below
/// gives; `visit(leaf)` returns the best so far, and what cannot beat it is left out.
template <typename Node, typename Bound, typename Visit>
void walk(const std::vector<Node>& nodes, const Bound& bound, const Visit& visit) {
  struct Open {
    std::uint32_t node;
    double bound;
  };
  std::array<Open, 64> open;  // the tree is balanced: no deeper than 32
  std::size_t count = 0;
  double best = kInfinity;
  open[count++] = {0, bound(nodes[0])};
  while (count > 0) {
    const Open next = open[--count];
    if (!(next.bound < best)) continue;
    const Node& node = nodes[next.node];
    if (node.count > 0) {
      best = visit(node);
      continue;
    }
    Open one{next.node + 1, bound(nodes[next.node + 1])},
        other{node.first, bound(nodes[node.first])};
    if (one.bound < other.bound) std::swap(one, other);
    open[count++] = one;
    open[count++] = other;
  }
}

}  // namespace

/// Halves the triangles by their centres along the longest side, until few are left.
struct TriangleTree::Builder {
  TriangleTree& tree;
  std::vector<Point> centres;
  std::vector<std::uint32_t> order;

  void add(std::uint32_t begin, std::uint32_t end) {
    const std::size_t place = tree.nodes_.size();
    tree.nodes_.push_back(box_around(begin, end));
    if (end - begin <= kLeafTriangles) {
      tree.nodes_[place].count = end - begin;
      tree.nodes_[place].first = begin;
      return;
    }
    Eigen::Index axis = 0;
    (tree.nodes_[place].high - tree.nodes_[place].low).maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b);
                     });
    add(begin, middle);
    tree.nodes_[place].first = static_cast<std::uint32_t>(tree.nodes_.size());
    add(middle, end);
  }

  Node box_around(std::uint32_t begin, std::uint32_t end) const {
    Node node{Point::Constant(kInfinity), Point::Constant(-kInfinity)};
    for (std::uint32_t i = begin; i < end; ++i)
      for (const std::uint32_t v : tree.triangles_[order[i]]) {
        node.low = node.low.cwiseMin(tree.vertices_[v]);
        node.high = node.high.cwiseMax(tree.vertices_[v]);
      }
    return node;
  }
};

TriangleTree::TriangleTree(std::vector<Point> vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  Builder builder{*this, {}, std::vector<std::uint32_t>(triangles_.size())};
  for (const auto& [a, b, c] : triangles_)
    builder.centres.emplace_back((vertices_[a] + vertices_[b] + vertices_[c]) / 3.0);
  std::iota(builder.order.begin(), builder.order.end(), 0u);
  builder.add(0, static_cast<std::uint32_t>(triangles_.size()));
  std::vector<Triangle> ordered;
  ordered.reserve(triangles_.size());
  for (const std::uint32_t triangle : builder.order) ordered.push_back(triangles_[triangle]);
  triangles_ = std::move(ordered);
}

TriangleTree::Nearest TriangleTree::nearest(const Point& p) const {
  Nearest nearest;
  walk(
      nodes_, [&](const Node& node) { return squared_distance_to_box(p, node.low, node.high); },
      [&](const Node& leaf) {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
          const auto& [a, b, c] = triangles_[i];
          const Foot foot = nearest_on_triangle(p, vertices_[a], vertices_[b], vertices_[c]);
          const double squared = (foot.point - p).squaredNorm();
          if (squared < nearest.squared_distance) nearest = {foot.point, squared, i, foot.corners};
        }
        return nearest.squared_distance;
      });
  return nearest;
}

TriangleTree::Hit TriangleTree::first_hit(const Point& origin, const Vector& direction) const {
  const ShearedRay ray(origin, direction);
  const BoxEntry entry(origin, direction, low(), high());
  Hit first;
  walk(
      nodes_, [&](const Node& node) { return entry.range(node.low, node.high); },
      [&](const Node& leaf) {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
          const auto& [a, b, c] = triangles_[i];
          const double range = ray.meets(vertices_[a], vertices_[b], vertices_[c]);
          if (range < first.range) first = {range, i};
        }
        return first.range;
      });
  return first;
}

std::optional<int> TriangleTree::winding_along(const Point& origin, const Vector& direction) const {
  const ShearedRay ray(origin, direction);
  const BoxEntry entry(origin, direction, low(), high());
  std::optional<int> winding = 0;
  walk(
      nodes_,
      [&](const Node& node) { return winding ? entry.range(node.low, node.high) : kInfinity; },
      [&](const Node& leaf) {
        for (std::uint32_t i = leaf.first; winding && i < leaf.first + leaf.count; ++i) {
          const auto& [a, b, c] = triangles_[i];
          const std::optional<int> side = ray.side_met(vertices_[a], vertices_[b], vertices_[c]);
          winding = side ? std::optional(*winding + *side) : std::nullopt;
        }
        return winding ? kInfinity : 0.0;
      });
  return winding;
}

}  // namespace ridgeway
