// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "touched_voxels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "memory_limit.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;

/// Where the centre of a cube may lie for the cube to touch a triangle: between two planes along
/// each of the axes that can separate the two, and in a box.
class CubeCentres {
 public:
  CubeCentres(const VoxelTriangles& mesh, std::uint32_t index, double half_side) {
    std::array<Vector, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = mesh.vertices[mesh.triangles[index][i]];
    low_ = v[0].cwiseMin(v[1]).cwiseMin(v[2]);
    high_ = v[0].cwiseMax(v[1]).cwiseMax(v[2]);
    // What rounding adds to a product with one of these coordinates, and to the vertices.
    const double far = std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff());
    reach_ = half_side + mesh.slack + 16.0 * std::numeric_limits<double>::epsilon() * (far + 1.0);
    low_.array() -= reach_;
    high_.array() += reach_;
    const std::array<Vector, 3> edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    add(edges[0].cross(edges[1]), v);
    for (const Vector& edge : edges)
      for (int axis = 0; axis < 3; ++axis) add(edge.cross(Vector(Vector::Unit(axis))), v);
  }

  const Vector& low() const { return low_; }
  const Vector& high() const { return high_; }

  bool contains(const Vector& centre) const {
    if ((centre.array() < low_.array()).any() || (centre.array() > high_.array()).any())
      return false;
    for (const Slab& slab : slabs_) {
      const double at = slab.axis.dot(centre);
      if (at < slab.low || at > slab.high) return false;
    }
    return true;
  }

  /// Bit i: the centre `first` moved by i along x lies between all planes.
  unsigned row(const Vector& first) const {
    std::array<int, kBlockSide> inside;
    inside.fill(1);
    for (const Slab& slab : slabs_) {
      const double at = slab.axis.dot(first), step = slab.axis.x();
      for (int i = 0; i < kBlockSide; ++i) {
        const double place = at + i * step;
        inside[static_cast<std::size_t>(i)] &= (place >= slab.low) & (place <= slab.high);
      }
    }
    unsigned bits = 0;
    for (int i = 0; i < kBlockSide; ++i)
      bits |= static_cast<unsigned>(inside[static_cast<std::size_t>(i)]) << i;
    return bits;
  }

 private:
  struct Slab {
    Vector axis;
    double low, high;
  };

  void add(const Vector& axis, const std::array<Vector, 3>& v) {
    const double a = axis.dot(v[0]), b = axis.dot(v[1]), c = axis.dot(v[2]);
    const double reach = reach_ * axis.cwiseAbs().sum();
    slabs_[count_++] = {axis, std::min({a, b, c}) - reach, std::max({a, b, c}) + reach};
  }

  std::array<Slab, 10> slabs_;
  std::size_t count_ = 0;
  Vector low_, high_;
  double reach_ = 0.0;
};

/// A cube of `side` blocks and the triangles that touch it.
struct Node {
  BlockIndex corner;
  std::vector<std::uint32_t> triangles;
};

Vector centre_of_cube(const BlockIndex& corner, int side) {
  const double half = 0.5 * side;
  return Vector(corner.x + half, corner.y + half, corner.z + half) * kBlockSide;
}

std::vector<std::uint32_t> touching(const VoxelTriangles& mesh, const Node& node,
                                    const BlockIndex& corner, int side) {
  const Vector centre = centre_of_cube(corner, side);
  std::vector<std::uint32_t> found;
  for (const std::uint32_t triangle : node.triangles)
    if (CubeCentres(mesh, triangle, 0.5 * side * kBlockSide).contains(centre))
      found.push_back(triangle);
  return found;
}

/// Cuts cubes of two blocks a side and more into eight, of which those that nothing touches go.
std::vector<Node> cut(const VoxelTriangles& mesh, const std::vector<Node>& nodes, int side,
                      const BlockIndex& last) {
  const int half = side / 2;
  std::vector<Node> children(8 * nodes.size());
  parallel_for_each_index(children.size(), [&](std::size_t i) {
    const Node& node = nodes[i / 8];
    const int c = static_cast<int>(i % 8);
    const BlockIndex corner = {node.corner.x + (c & 1) * half, node.corner.y + (c >> 1 & 1) * half,
                               node.corner.z + (c >> 2) * half};
    if (corner.x > last.x || corner.y > last.y || corner.z > last.z) return;
    children[i] = {corner, touching(mesh, node, corner, half)};
  });
  std::erase_if(children, [](const Node& node) { return node.triangles.empty(); });
  return children;
}

void mark(const VoxelTriangles& mesh, const Node& node, const VoxelIndex& size,
          VoxelMask::Block& voxels) {
  const VoxelIndex corner = voxel_of(node.corner, 0);
  const Vector first = Vector(corner.x, corner.y, corner.z).array() + 0.5;
  const Vector most(std::min(kBlockSide, size.x - corner.x) - 1,
                    std::min(kBlockSide, size.y - corner.y) - 1,
                    std::min(kBlockSide, size.z - corner.z) - 1);
  for (const std::uint32_t triangle : node.triangles) {
    const CubeCentres centres(mesh, triangle, 0.5);
    const Vector low = (centres.low() - first).array().ceil().max(0.0),
                 high = (centres.high() - first).array().floor().min(most.array());
    if ((low.array() > high.array()).any()) continue;
    const auto x0 = static_cast<unsigned>(low.x()), x1 = static_cast<unsigned>(high.x());
    const unsigned columns = (0xffu << x0) & (0xffu >> (7 - x1));
    for (int z = static_cast<int>(low.z()); z <= static_cast<int>(high.z()); ++z)
      for (int y = static_cast<int>(low.y()); y <= static_cast<int>(high.y()); ++y) {
        const std::uint64_t row = centres.row(first + Vector(0, y, z)) & columns;
        voxels[static_cast<std::size_t>(z)] |= row << (kBlockSide * y);
      }
  }
}

void require_room(const std::vector<Node>& nodes, const std::string& name) {
  double bytes = 0.0;
  for (const Node& node : nodes)
    bytes +=
        static_cast<double>(8 * sizeof(Node)) + 4.0 * static_cast<double>(node.triangles.size());
  require_memory(4.0 * bytes, name, "use larger voxels, or a mesh of fewer large triangles");
}

}  // namespace

VoxelTriangles from_voxel(const VoxelIndex& origin, std::vector<Point> vertices,
                          std::vector<Triangle> triangles, double off, const std::string& name) {
  constexpr double kFarthest = 4e9;  // voxels
  const Point corner(origin.x, origin.y, origin.z);
  double farthest = corner.cwiseAbs().maxCoeff();
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t v : triangle) {
      const double far = vertices[v].cwiseAbs().maxCoeff();
      if (!(far <= kFarthest))
        throw InputError(name, "has a mesh that reaches farther than 4e9 voxels from zero",
                         "check its scale, or give a larger voxel_size");
      farthest = std::max(farthest, far);
    }
  for (Point& vertex : vertices) vertex -= corner;
  return {std::move(vertices), std::move(triangles),
          32.0 * std::numeric_limits<double>::epsilon() * farthest + off};
}

BlockMasks touched_voxels(const VoxelTriangles& mesh, const VoxelIndex& size,
                          const std::string& name) {
  const BlockIndex last = block_of(size - VoxelIndex{1, 1, 1});
  Node root{{0, 0, 0}, std::vector<std::uint32_t>(mesh.triangles.size())};
  std::iota(root.triangles.begin(), root.triangles.end(), 0u);
  const auto widest = static_cast<unsigned>(std::max({last.x, last.y, last.z}) + 1);
  std::vector<Node> nodes = {std::move(root)};
  for (auto side = static_cast<int>(std::bit_ceil(widest)); side > 1; side /= 2) {
    require_room(nodes, name);
    nodes = cut(mesh, nodes, side, last);
  }
  std::sort(nodes.begin(), nodes.end(),
            [](const Node& a, const Node& b) { return a.corner < b.corner; });
  BlockMasks masks;
  masks.voxels.resize(nodes.size());
  for (const Node& node : nodes) masks.blocks.push_back(node.corner);
  parallel_for_each_index(nodes.size(),
                          [&](std::size_t i) { mark(mesh, nodes[i], size, masks.voxels[i]); });
  return masks;
}

}  // namespace ridgeway
