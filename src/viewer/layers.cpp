// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "layers.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "layer_bytes.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"
#include "surface_quads.hpp"

namespace ridgeway {
namespace {

using detail::append;
using detail::append_origin;
using detail::count_of;
using detail::map_origin;

/// Metres from the map's own zero.
void append_position(std::string& bytes, const Point& local) {
  for (const double x : local) append(bytes, static_cast<float>(x));
}

float clearance_of_voxel(const EsdfMap& esdf, VoxelId id) {
  return static_cast<float>(esdf.distance(id));
}

/// Cells of `stride` voxels that cover a horizontal layer, from the voxel (x, y) on.
struct LayerGrid {
  int x = 0, y = 0, stride = 1, columns = 0, rows = 0;
  int width = 0, depth = 0;  // voxels

  /// The voxel in the middle of a cell: the last one may have less than a stride.
  VoxelIndex middle_of(int column, int row, int layer) const {
    const auto middle = [this](int cell, int end) {
      const int first = cell * stride;
      return first + std::min(stride, end - first) / 2;
    };
    return {x + middle(column, width), y + middle(row, depth), layer};
  }
};

constexpr double kBeside = 1e-3;  // of a voxel: heights between two layers come with rounding

/// How many voxels a height (world, metres) is above the map's zero.
double voxels_up(const EsdfMap& esdf, double height) {
  const double up = to_local(esdf, Point(0.0, 0.0, height)).z() / esdf.voxel_size;
  if (!std::isfinite(up) || std::abs(up) >= kMaxVoxelIndex)
    throw InputError("z", "is no height that a voxel can have", "give metres, in the map's frame");
  return up;
}

LayerGrid grid_of_layer(const EsdfMap& esdf, int layer, int most_cells) {
  BlockIndex low{0, 0, 0}, high{-1, -1, 0};
  bool any = false;
  for (const BlockIndex& b : esdf.layout.blocks()) {
    if (b.z != layer >> kBlockBits) continue;
    low = any ? BlockIndex{std::min(low.x, b.x), std::min(low.y, b.y), 0} : b;
    high = any ? BlockIndex{std::max(high.x, b.x), std::max(high.y, b.y), 0} : b;
    any = true;
  }
  const std::int64_t width = (std::int64_t{high.x} - low.x + 1) * kBlockSide,
                     depth = (std::int64_t{high.y} - low.y + 1) * kBlockSide;
  const std::int64_t stride =
      std::max<std::int64_t>(1, (std::max(width, depth) + most_cells - 1) / most_cells);
  return {low.x * kBlockSide,
          low.y * kBlockSide,
          static_cast<int>(stride),
          static_cast<int>((width + stride - 1) / stride),
          static_cast<int>((depth + stride - 1) / stride),
          static_cast<int>(width),
          static_cast<int>(depth)};
}

/// The grid's corner at a height in voxels, the side of its cells, and how many there are.
void append_grid(std::string& bytes, const EsdfMap& esdf, const LayerGrid& grid, double up) {
  append_origin(bytes, to_world(esdf, Point(grid.x, grid.y, up) * esdf.voxel_size));
  append(bytes, grid.stride * esdf.voxel_size);
  append(bytes, static_cast<std::uint32_t>(grid.columns));
  append(bytes, static_cast<std::uint32_t>(grid.rows));
}

}  // namespace

std::string surface_layer(const EsdfMap& esdf, std::size_t most_quads) {
  const SurfaceQuads surface = merge_surface_within(esdf, most_quads);
  std::string bytes;
  bytes.reserve(40 + 12 * surface.quads.size());
  const VoxelIndex& low = surface.low;
  append_origin(bytes, to_world(esdf, Point(low.x, low.y, low.z) * esdf.voxel_size));
  append(bytes, surface.cell_voxels * esdf.voxel_size);
  append(bytes, count_of(surface.quads.size()));
  append(bytes, static_cast<std::uint32_t>(surface.cell_voxels));
  for (const SurfaceQuad& q : surface.quads)
    for (const std::uint16_t part : {q.x, q.y, q.z, q.side}) append(bytes, part);
  for (const SurfaceQuad& q : surface.quads)
    for (const std::uint8_t part : {q.width, q.height, std::uint8_t{0}, std::uint8_t{0}})
      append(bytes, part);
  return bytes;
}

std::string slice_layer(const EsdfMap& esdf, double height, int most_samples) {
  constexpr std::uint16_t kNotKnown = 65535;
  constexpr double kFarthest = 65534.0;  // millimetres
  const int layer = floor_to_int(voxels_up(esdf, height) + kBeside);
  const LayerGrid grid = grid_of_layer(esdf, layer, most_samples);
  std::string bytes;
  append_grid(bytes, esdf, grid, layer + 0.5);
  VoxelFinder finder(esdf.layout);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const VoxelId id = finder.find(grid.middle_of(column, row, layer));
      if (id == kNoVoxel || esdf.state[id] == VoxelState::kUnknown)
        append(bytes, kNotKnown);
      else
        append(bytes, static_cast<std::uint16_t>(
                          std::min(kFarthest, std::round(1000.0 * esdf.distance(id)))));
    }
  return bytes;
}

std::string section_layer(const EsdfMap& esdf, double height, int most_cells) {
  // A height between two layers is of both.
  const double up = voxels_up(esdf, height);
  const int below = floor_to_int(up - kBeside), above = floor_to_int(up + kBeside);
  const LayerGrid grid = grid_of_layer(esdf, below, most_cells);
  VoxelFinder finder(esdf.layout);
  std::vector<bool> is_cut(static_cast<std::size_t>(grid.columns) *
                           static_cast<std::size_t>(grid.rows));
  const auto look = [&](VoxelId id) {
    if (esdf.state[id] != VoxelState::kOccupied) return;
    const VoxelIndex v = esdf.layout.index_of(id);
    const VoxelId over = finder.find({v.x, v.y, above});
    if (over != kNoVoxel && esdf.state[over] == VoxelState::kFree) return;
    const int column = (v.x - grid.x) / grid.stride, row = (v.y - grid.y) / grid.stride;
    is_cut[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
           static_cast<std::size_t>(column)] = true;
  };
  constexpr int kInLayer = kBlockSide * kBlockSide;
  for (std::uint32_t slot = 0; slot < esdf.layout.block_count(); ++slot) {
    if (esdf.layout.block(slot).z != below >> kBlockBits) continue;
    const VoxelId first =
        VoxelId{slot} * kBlockVoxels + static_cast<VoxelId>(kInLayer * (below & (kBlockSide - 1)));
    for (VoxelId id = first; id < first + kInLayer; ++id) look(id);
  }
  std::string bytes;
  append_grid(bytes, esdf, grid, up);
  for (std::size_t first = 0; first < is_cut.size(); first += 8) {
    unsigned eight = 0;
    for (std::size_t k = 0; k < 8 && first + k < is_cut.size(); ++k)
      if (is_cut[first + k]) eight |= 1U << k;
    append(bytes, static_cast<std::uint8_t>(eight));
  }
  return bytes;
}

std::string diagram_layer(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::vector<VoxelId> voxels = roadmap.diagram.voxels.members(esdf.layout);
  const auto by_order = [&](VoxelId a, VoxelId b) {
    return esdf.layout.order_of(a) < esdf.layout.order_of(b);
  };
  std::string segments;
  for (std::size_t i = 0; i < voxels.size(); ++i)
    for (int direction = kCentre + 1; direction < 27; ++direction) {
      const VoxelId other = esdf.layout.neighbour(voxels[i], direction);
      if (other == kNoVoxel || !roadmap.diagram.voxels.test(other)) continue;
      append(segments, count_of(i));
      append(segments, count_of(static_cast<std::size_t>(
                           std::lower_bound(voxels.begin(), voxels.end(), other, by_order) -
                           voxels.begin())));
    }
  std::string bytes;
  append_origin(bytes, map_origin(esdf));
  append(bytes, count_of(voxels.size()));
  append(bytes, count_of(segments.size() / 8));
  for (const VoxelId id : voxels)
    append_position(bytes, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
  for (const VoxelId id : voxels) append(bytes, clearance_of_voxel(esdf, id));
  return bytes + segments;
}

std::string gvd_layer(const Roadmap& roadmap, const GvdConfig& config, std::size_t most_points) {
  const EsdfMap& esdf = roadmap.esdf;
  const VoxelMask traversable = traversable_voxels(esdf, roadmap.min_clearance);
  const std::vector<VoxelId> voxels = compute_gvd(esdf, traversable, config).members(esdf.layout);
  const std::size_t stride =
      std::max<std::size_t>(1, (voxels.size() + most_points - 1) / most_points);
  std::vector<VoxelId> shown;
  for (std::size_t i = 0; i < voxels.size(); i += stride) shown.push_back(voxels[i]);
  std::string bytes;
  append_origin(bytes, map_origin(esdf));
  append(bytes, count_of(shown.size()));
  append(bytes, count_of(voxels.size()));
  for (const VoxelId id : shown)
    append_position(bytes, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
  for (const VoxelId id : shown) append(bytes, clearance_of_voxel(esdf, id));
  return bytes;
}

std::string graph_layer(const Roadmap& roadmap) {
  const SparseGraph& graph = roadmap.graph;
  std::string bytes;
  append_origin(bytes, map_origin(roadmap.esdf));
  append(bytes, count_of(graph.vertices.size()));
  append(bytes, count_of(graph.edges.size()));
  for (const Vertex& v : graph.vertices) append_position(bytes, v.position);
  for (const Vertex& v : graph.vertices) append(bytes, static_cast<float>(v.clearance));
  for (const Edge& e : graph.edges) {
    append(bytes, count_of(number(e.from)));
    append(bytes, count_of(number(e.to)));
  }
  for (const Edge& e : graph.edges) append(bytes, static_cast<float>(e.clearance));
  return bytes;
}

std::string components_layer(std::span<const std::size_t> components) {
  std::string bytes;
  append(bytes, count_of(components.size()));
  for (const std::size_t component : components) append(bytes, count_of(component));
  return bytes;
}

}  // namespace ridgeway
