// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "attach_way.hpp"

#include <algorithm>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

VertexId vertex_at(const SparseGraph& graph, const VoxelIndex& voxel) {
  // Vertices are in the order of their voxels: by block, then by place in the block.
  const auto key = [](const VoxelIndex& v) { return std::pair(block_of(v), local_of(v)); };
  const auto place =
      std::lower_bound(graph.vertices.begin(), graph.vertices.end(), voxel,
                       [&](const Vertex& a, const VoxelIndex& b) { return key(a.voxel) < key(b); });
  if (place == graph.vertices.end() || place->voxel != voxel) return kNoVertex;
  return VertexId{static_cast<std::uint32_t>(place - graph.vertices.begin())};
}

AttachWay follow_attach(const Roadmap& roadmap, VoxelId from, double radius) {
  const EsdfMap& esdf = roadmap.esdf;
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  const FreeSpace space(esdf);
  AttachWay way;
  SquaredHalves narrowest(std::numeric_limits<double>::infinity());
  const auto stop = [&] {
    way.clearance = narrowest.metres(esdf.voxel_size);
    return way;
  };
  for (VoxelId id = from;;) {
    way.voxels.push_back(id);
    way.met_diagram |= roadmap.diagram.voxels.test(id);
    const Direction next = roadmap.attach.next[id];
    if (next == AttachField::kHere) {
      way.vertex = vertex_at(roadmap.graph, esdf.layout.index_of(id));
      return stop();
    }
    if (next == AttachField::kNotTraversable) return stop();
    const VoxelId to = esdf.layout.neighbour(id, next);
    if (to == kNoVoxel) return stop();
    // Ways lead away from obstacles: mostly the first moves are the narrowest.
    if (FreeSpace::move_bound(esdf.squared[id], esdf.squared[to], squared_length(next)) <
        narrowest) {
      const SquaredHalves clearance = space.move_clearance(id, to, next);
      if (clearance < threshold) return stop();
      narrowest = std::min(narrowest, clearance);
    }
    id = to;
  }
}

}  // namespace ridgeway::detail
