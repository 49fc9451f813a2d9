// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "voxel/for_each_voxel.hpp"

// Marching tetrahedra (Doi and Koide 1991). Every cell between eight voxel centres is cut into the
// six tetrahedra that climb from its lowest corner to its highest, one axis after the other (Kuhn
// 1960). Those of neighbouring cells meet face to face, and a plane cuts a tetrahedron in one way
// only, so the surface is a manifold with no table of cases. Marching cubes needs 256 of them and
// care with faces that can be joined in two ways; surface nets pinch where two sheets pass through
// one cell. The price is about twice the triangles.

namespace ridgeway {
namespace {

using detail::for_each_voxel;

/// A corner of a cell, or a step up from one corner to another: bit 0 for x, 1 for y, 2 for z.
using Corner = unsigned;
constexpr Corner kHighest = 7;

VoxelId up(const BlockLayout& layout, VoxelId id, Corner c) {
  return layout.step(id, static_cast<int>(c & 1), static_cast<int>(c >> 1 & 1),
                     static_cast<int>(c >> 2));
}
VoxelId down(const BlockLayout& layout, VoxelId id, Corner c) {
  return layout.step(id, -static_cast<int>(c & 1), -static_cast<int>(c >> 1 & 1),
                     -static_cast<int>(c >> 2));
}

bool is_known(const TsdfMap& tsdf, VoxelId id) { return id != kNoVoxel && tsdf.weight[id] > 0.0f; }
bool is_inside(const TsdfMap& tsdf, VoxelId id) { return tsdf.distance[id] <= 0.0f; }

/// Cells, by their lowest corner, of which all corners are known.
VoxelMask find_cells(const TsdfMap& tsdf) {
  VoxelMask cells(tsdf.layout);
  for_each_voxel(tsdf.layout, [&](VoxelId id) {
    for (Corner c = 0; c <= kHighest; ++c)
      if (!is_known(tsdf, up(tsdf.layout, id, c))) return;
    cells.set(id);
  });
  return cells;
}

/// Edges of tetrahedra that the surface crosses, each at one vertex. An edge belongs to the voxel
/// at its lower end.
struct Crossings {
  VoxelField<std::uint8_t> steps;   ///< bit s: the edge up by step s (1 to 7) is crossed
  VoxelField<std::uint32_t> first;  ///< number of the voxel's first vertex
  std::size_t count = 0;

  std::uint32_t vertex(VoxelId low, Corner step) const {
    const unsigned before = steps[low] & ((1u << step) - 1);
    return first[low] + static_cast<std::uint32_t>(bit_count(before));
  }
};

bool is_in_a_cell(const BlockLayout& layout, const VoxelMask& cells, VoxelId low, Corner step) {
  for (Corner c = 0; c <= kHighest; ++c) {
    if ((c & step) != 0) continue;
    const VoxelId cell = down(layout, low, c);
    if (cell != kNoVoxel && cells.test(cell)) return true;
  }
  return false;
}

Crossings find_crossings(const TsdfMap& tsdf, const VoxelMask& cells) {
  constexpr std::size_t kMostVertices = 0x7fffffff;  // programs read signed indices
  Crossings crossings{VoxelField<std::uint8_t>(tsdf.layout), VoxelField<std::uint32_t>(tsdf.layout),
                      0};
  for_each_voxel(tsdf.layout, [&](VoxelId id) {
    if (!is_known(tsdf, id)) return;
    for (Corner step = 1; step <= kHighest; ++step) {
      const VoxelId other = up(tsdf.layout, id, step);
      if (is_known(tsdf, other) && is_inside(tsdf, id) != is_inside(tsdf, other) &&
          is_in_a_cell(tsdf.layout, cells, id, step))
        crossings.steps[id] |= static_cast<std::uint8_t>(1u << step);
    }
  });
  for (std::uint32_t order = 0; order < tsdf.layout.voxel_count(); ++order) {
    const VoxelId id = tsdf.layout.voxel_at_order(order);
    crossings.first[id] = static_cast<std::uint32_t>(crossings.count);
    crossings.count += static_cast<std::size_t>(bit_count(crossings.steps[id]));
    if (crossings.count > kMostVertices)
      throw InputError("surface", "has more than 2^31 vertices", "fuse with a larger voxel size");
  }
  return crossings;
}

/// In the map's own frame.
std::vector<Point> place_vertices(const TsdfMap& tsdf, const Crossings& crossings) {
  constexpr double kLeast = 1e-3;  // of an edge, so that no triangle vanishes at a distance of 0
  std::vector<Point> vertices(crossings.count);
  for_each_voxel(tsdf.layout, [&](VoxelId id) {
    for (unsigned steps = crossings.steps[id]; steps != 0; steps &= steps - 1) {
      const auto step = static_cast<Corner>(std::countr_zero(steps));
      const double here = tsdf.distance[id], there = tsdf.distance[up(tsdf.layout, id, step)];
      const double share = std::clamp(here / (here - there), kLeast, 1.0 - kLeast);
      const Eigen::Vector3d edge(step & 1, step >> 1 & 1, step >> 2);
      vertices[crossings.vertex(id, step)] =
          centre_of(tsdf.layout.index_of(id), tsdf.voxel_size) + share * tsdf.voxel_size * edge;
    }
  });
  return vertices;
}

struct Cell {
  std::array<VoxelId, 8> voxel{};
  unsigned inside = 0;  ///< a bit for each corner

  bool has_inside(Corner c) const { return (inside >> c & 1) != 0; }
};

/// Adds the triangles that part the corners of a tetrahedron inside from those outside.
/// `right_handed`: seen from the first corner, the others stand clockwise.
void cut_tetrahedron(const Crossings& crossings, const Cell& cell, std::array<Corner, 4> corners,
                     bool right_handed, std::vector<Triangle>& triangles) {
  // The corners inside come first. Every swap is a reflection; one more undoes an odd number.
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t k = i;
         k > 0 && cell.has_inside(corners[k]) && !cell.has_inside(corners[k - 1]); --k) {
      std::swap(corners[k], corners[k - 1]);
      right_handed = !right_handed;
    }
  const auto inside =
      std::count_if(corners.begin(), corners.end(), [&](Corner c) { return cell.has_inside(c); });
  if (!right_handed) {
    if (inside == 1)
      std::swap(corners[2], corners[3]);
    else
      std::swap(corners[0], corners[1]);
  }
  // Of two corners of a tetrahedron the bits of the lower one are among those of the other.
  const auto vertex = [&](std::size_t i, std::size_t k) {
    return crossings.vertex(cell.voxel[corners[i] & corners[k]], corners[i] ^ corners[k]);
  };
  if (inside == 1) triangles.push_back({vertex(0, 1), vertex(0, 2), vertex(0, 3)});
  if (inside == 3) triangles.push_back({vertex(0, 3), vertex(1, 3), vertex(2, 3)});
  if (inside == 2) {
    triangles.push_back({vertex(0, 2), vertex(0, 3), vertex(1, 3)});
    triangles.push_back({vertex(0, 2), vertex(1, 3), vertex(1, 2)});
  }
}

void cut_cell(const TsdfMap& tsdf, const Crossings& crossings, VoxelId lowest,
              std::vector<Triangle>& triangles) {
  Cell cell;
  for (Corner c = 0; c <= kHighest; ++c) {
    cell.voxel[c] = up(tsdf.layout, lowest, c);
    cell.inside |= static_cast<unsigned>(is_inside(tsdf, cell.voxel[c])) << c;
  }
  if (cell.inside == 0 || cell.inside == 0xff) return;
  for (unsigned first = 0; first < 3; ++first)
    for (const unsigned turn : {1u, 2u}) {
      const Corner one = 1u << first, two = one | 1u << (first + turn) % 3;
      cut_tetrahedron(crossings, cell, {0, one, two, kHighest}, turn == 1, triangles);
    }
}

std::vector<Triangle> find_triangles(const TsdfMap& tsdf, const VoxelMask& cells,
                                     const Crossings& crossings) {
  std::vector<std::vector<Triangle>> of_block(tsdf.layout.block_count());
  for_each_voxel(tsdf.layout, [&](VoxelId id) {
    if (cells.test(id)) cut_cell(tsdf, crossings, id, of_block[id / kBlockVoxels]);
  });
  std::vector<Triangle> triangles;
  for (std::uint32_t rank = 0; rank < of_block.size(); ++rank) {
    std::vector<Triangle>& some = of_block[tsdf.layout.slot_at(rank)];
    triangles.insert(triangles.end(), some.begin(), some.end());
    std::vector<Triangle>().swap(some);
  }
  return triangles;
}

/// Means over the triangles at a vertex, weighted by their areas. They never cancel: each looks to
/// the same side along the edge that the vertex lies on.
std::vector<Eigen::Vector3d> find_normals(const SurfaceMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point& p = mesh.vertices[a];
    const Eigen::Vector3d area = (mesh.vertices[b] - p).cross(mesh.vertices[c] - p);
    for (const std::uint32_t v : {a, b, c}) normals[v] += area;
  }
  for (Eigen::Vector3d& normal : normals) normal.normalize();
  return normals;
}

}  // namespace

SurfaceMesh surface_of(const TsdfMap& tsdf) {
  const VoxelMask cells = find_cells(tsdf);
  const Crossings crossings = find_crossings(tsdf, cells);
  SurfaceMesh mesh;
  mesh.vertices = place_vertices(tsdf, crossings);
  mesh.triangles = find_triangles(tsdf, cells, crossings);
  mesh.normals = find_normals(mesh);
  for (Point& vertex : mesh.vertices) vertex = to_world(tsdf, vertex);
  return mesh;
}

}  // namespace ridgeway
