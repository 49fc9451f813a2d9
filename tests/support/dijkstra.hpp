// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>
#include <map>
#include <set>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway::testing {

/// Shortest lengths (voxels) from a voxel over legal 26-moves, plainly: no heuristic, every move
/// asked as a segment.
inline std::map<VoxelId, double> dijkstra_voxels(const EsdfMap& esdf, VoxelId start, double radius,
                                                 const VoxelMask* within = nullptr) {
  const FreeSpace space(esdf);
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  std::map<VoxelId, double> cost{{start, 0.0}};
  std::set<std::pair<double, VoxelId>> open{{0.0, start}};
  while (!open.empty()) {
    const auto [at, id] = *open.begin();
    open.erase(open.begin());
    const Point here = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf.layout.neighbour(id, d);
      if (d == kCentre || next == kNoVoxel || !esdf.is_open(next) ||
          esdf.squared[next] < threshold || (within != nullptr && !within->test(next)))
        continue;
      const Point there = centre_of(esdf.layout.index_of(next), esdf.voxel_size);
      if (!space.is_free(here, there, radius)) continue;
      const double length = at + std::sqrt(static_cast<double>(squared_length(d)));
      const auto known = cost.find(next);
      if (known != cost.end() && known->second <= length + 1e-12) continue;
      if (known != cost.end()) open.erase({known->second, next});
      cost[next] = length;
      open.insert({length, next});
    }
  }
  return cost;
}

/// Shortest lengths (metres) from a vertex over edges of at least a clearance.
inline std::map<VertexId, double> dijkstra_graph(const SparseGraph& graph, VertexId start,
                                                 double radius) {
  std::map<VertexId, double> cost{{start, 0.0}};
  for (bool changed = true; changed;) {  // Bellman and Ford: nothing in common with A*
    changed = false;
    for (const Edge& edge : graph.edges) {
      if (edge.clearance < radius * (1 - 1e-9)) continue;
      for (const auto& [a, b] : {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)}) {
        const auto from = cost.find(a);
        if (from == cost.end()) continue;
        const double length = from->second + edge.length;
        const auto to = cost.find(b);
        if (to != cost.end() && to->second <= length + 1e-12) continue;
        cost[b] = length;
        changed = true;
      }
    }
  }
  return cost;
}

}  // namespace ridgeway::testing
