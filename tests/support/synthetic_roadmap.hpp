// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <random>
#include <set>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

struct SyntheticConfig {
  int rooms_x = 3, rooms_y = 2;  ///< rooms of 24 x 24 voxels, doors of 6 in all inner walls
  int room = 24;
  int height = 20;
  double voxel_size = 0.1;
  UnknownPolicy unknown = UnknownPolicy::kObstacle;
  double max_distance = std::numeric_limits<double>::infinity();
  std::size_t vertices = 40;
  std::uint32_t seed = 1;
};

/// A storey of rooms as an occupancy map: floor and ceiling, walls with doors, some furniture, a
/// shadow of unknown voxels in every room. Partly at negative indices, and far from the world's
/// zero.
inline OccupancyMap synthetic_map(const SyntheticConfig& config) {
  const int X = config.rooms_x * config.room + 1, Y = config.rooms_y * config.room + 1,
            Z = config.height;
  const VoxelIndex corner{-13, 21, -3};
  std::vector<BlockIndex> blocks;
  for (int z = 0; z < Z; z += 1)
    for (int y = 0; y < Y; y += 1)
      for (int x = 0; x < X; x += 8) blocks.push_back(block_of(corner + VoxelIndex{x, y, z}));
  for (int z = 0; z < Z; ++z)
    for (int y = 0; y < Y; ++y) blocks.push_back(block_of(corner + VoxelIndex{X - 1, y, z}));
  OccupancyMap map;
  map.voxel_size = config.voxel_size;
  map.origin = {4'650'000, -53'000'001, 123};
  map.layout = BlockLayout(std::move(blocks));
  map.state = VoxelField<VoxelState>(map.layout);
  for (int z = 0; z < Z; ++z)
    for (int y = 0; y < Y; ++y)
      for (int x = 0; x < X; ++x) {
        const int u = x % config.room, v = y % config.room, mid = config.room / 2;
        const bool outer = x == 0 || y == 0 || x == X - 1 || y == Y - 1;
        const bool door =
            !outer && z < 2 * Z / 3 && (u == 0 ? std::abs(v - mid) < 4 : std::abs(u - mid) < 4);
        const bool wall = z == 0 || z == Z - 1 || ((u == 0 || v == 0) && !door);
        const bool table = u > 15 && u < 19 && v > 3 && v < 8 && z < 6;
        const bool shadow = u > 19 && v > 20;
        map.state[map.layout.find(corner + VoxelIndex{x, y, z})] = wall || table
                                                                       ? VoxelState::kOccupied
                                                                   : shadow ? VoxelState::kUnknown
                                                                            : VoxelState::kFree;
      }
  return map;
}

/// A roadmap whose parts are consistent but, apart from distance field and edges, made up.
inline Roadmap synthetic_roadmap(const SyntheticConfig& config = {}) {
  Roadmap roadmap;
  std::mt19937 random(config.seed);
  roadmap.esdf = compute_esdf(synthetic_map(config), {config.unknown, config.max_distance});
  const EsdfMap& esdf = roadmap.esdf;
  roadmap.min_clearance = 0.3;
  roadmap.source = "rooms \"\u00e4\" \\ \n";
  roadmap.config = R"({"min_clearance": 0.3})";
  roadmap.diagram.voxels = VoxelMask(esdf.layout);
  roadmap.attach.next = VoxelField<Direction>(esdf.layout, AttachField::kNotTraversable);

  std::vector<VoxelId> open;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (!esdf.is_open(id) || esdf.distance(id) < 0.3) continue;
    open.push_back(id);
    if (random() % 20 == 0) roadmap.diagram.voxels.set(id);
  }
  std::shuffle(open.begin(), open.end(), random);
  open.resize(std::min(open.size(), config.vertices));
  std::sort(open.begin(), open.end());
  const SquaredHalves low = least_clearance(0.3, esdf.voxel_size);
  for (const VoxelId id : open) {
    const VoxelIndex voxel = esdf.layout.index_of(id);
    roadmap.graph.vertices.push_back({voxel, centre_of(voxel, esdf.voxel_size), esdf.distance(id)});
    roadmap.attach.next[id] = AttachField::kHere;
  }
  for (std::size_t i = 0; i < open.size(); ++i) {  // flood from the vertices
    for (int d = 0; d < 27; ++d) {
      const VoxelId n = esdf.layout.neighbour(open[i], d);
      if (n == kNoVoxel || !esdf.is_open(n) || esdf.squared[n] < low ||
          roadmap.attach.next[n] != AttachField::kNotTraversable) {
        continue;
      }
      roadmap.attach.next[n] = static_cast<Direction>(opposite(d));
      open.push_back(n);
    }
  }

  SparseGraph& graph = roadmap.graph;
  graph.min_clearance = 0.3;
  const FreeSpace space(esdf);
  const auto count = static_cast<std::uint32_t>(graph.vertices.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t v = 0; v < count; ++v) {
    std::uint32_t best = v;
    for (std::uint32_t w = 0; w < v; ++w) {
      const auto length = [&](std::uint32_t a) {
        return (graph.vertices[a].position - graph.vertices[v].position).norm();
      };
      if (best == v || length(w) < length(best)) best = w;
    }
    if (best != v && space.is_free(graph.vertices[best].position, graph.vertices[v].position, 0.3))
      pairs.insert({best, v});
    roadmap.tree.parent.push_back(VertexId{best});
    roadmap.tree.clearance.push_back(best == v ? 0.0 : 0.3 + 1.0 / (3.0 + v));
    roadmap.tree.place.push_back(best == v ? VoxelIndex{} : graph.vertices[v].voxel);
  }
  for (const auto& [a, b] : pairs) {
    const Point &from = graph.vertices[a].position, &to = graph.vertices[b].position;
    graph.edges.push_back(
        {VertexId{a}, VertexId{b}, (to - from).norm(), space.clearance(from, to)});
  }
  index_links(graph);

  if (graph.vertices.empty()) return roadmap;
  TangentGraph& tangents = roadmap.tangents;
  tangents.graph = graph;
  BlockRegions regions = number_regions(esdf.layout);
  tangents.region_of_block = std::move(regions.region_of_block);
  tangents.first_seen = {0};
  for (std::uint32_t region = 0; region < regions.count; ++region) {
    for (std::uint32_t k = 0; k < region % 3; ++k)
      tangents.seen.push_back(VertexId{(region + k) % count});
    tangents.first_seen.push_back(static_cast<std::uint32_t>(tangents.seen.size()));
  }
  return roadmap;
}

}  // namespace ridgeway
