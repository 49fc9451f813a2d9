// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "diagram_curves.hpp"

#include <algorithm>
#include <array>
#include <queue>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

DiagramNumber DiagramCurves::find(VoxelId id) const {
  const auto it = std::lower_bound(voxels.begin(), voxels.end(), id);
  return it != voxels.end() && *it == id ? static_cast<DiagramNumber>(it - voxels.begin())
                                         : kNowhere;
}

DiagramCurves index_diagram(const EsdfMap& esdf, const VoxelMask& diagram, double min_clearance) {
  constexpr std::array<float, 4> kLengths{0.0f, 1.0f, 1.41421356f, 1.73205081f};
  const double threshold = squared_threshold(min_clearance, esdf.voxel_size);
  const FreeSpace space(esdf);
  DiagramCurves curves;
  curves.voxels = diagram.members();
  curves.squared.resize(curves.size());
  curves.position.resize(curves.size());
  std::vector<std::vector<DiagramMove>> moves(curves.size());
  parallel_for_each_index(
      curves.size(),
      [&](std::size_t i) {
        const VoxelId id = curves.voxels[i];
        curves.squared[i] = esdf.squared[id];
        curves.position[i] = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
        for (Cube27 cube = cube_around(esdf.layout, diagram, id) & kCells26; cube != 0;
             cube &= cube - 1) {
          const int d = std::countr_zero(cube);
          const VoxelId other = esdf.layout.neighbour(id, d);
          const double width = space.move_clearance(id, other, d);
          if (width < threshold) continue;
          moves[i].push_back(
              {curves.find(other), kLengths[static_cast<std::size_t>(squared_length(d))], width});
        }
      },
      64);
  curves.first_move.push_back(0);
  for (const std::vector<DiagramMove>& of_voxel : moves) {
    curves.moves.insert(curves.moves.end(), of_voxel.begin(), of_voxel.end());
    curves.first_move.push_back(static_cast<std::uint32_t>(curves.moves.size()));
  }
  return curves;
}

DiagramFlood flood_from(const DiagramCurves& curves, std::span<const DiagramNumber> vertices) {
  struct Entry {
    double width;
    float distance;
    DiagramNumber voxel, from;
    bool operator<(const Entry& other) const {  // the queue's top is widest, then nearest
      if (width != other.width) return width < other.width;
      if (distance != other.distance) return distance > other.distance;
      return voxel != other.voxel ? voxel > other.voxel : from > other.from;
    }
  };
  DiagramFlood flood;
  flood.vertex.assign(curves.size(), kNowhere);
  flood.toward.assign(curves.size(), kNowhere);
  flood.width.assign(curves.size(), 0.0);
  flood.distance.assign(curves.size(), 0.0f);
  std::priority_queue<Entry> queue;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    flood.vertex[vertices[i]] = i;
    queue.push({static_cast<double>(curves.squared[vertices[i]]), 0.0f, vertices[i], vertices[i]});
  }
  while (!queue.empty()) {
    const Entry entry = queue.top();
    queue.pop();
    if (flood.toward[entry.voxel] != kNowhere) continue;
    flood.toward[entry.voxel] = entry.from;
    flood.vertex[entry.voxel] = flood.vertex[entry.from];
    flood.width[entry.voxel] = entry.width;
    flood.distance[entry.voxel] = entry.distance;
    for (const DiagramMove& move : curves.moves_of(entry.voxel))
      if (flood.toward[move.to] == kNowhere)
        queue.push({std::min(entry.width, move.width), entry.distance + move.length, move.to,
                    entry.voxel});
  }
  return flood;
}

}  // namespace ridgeway::detail
