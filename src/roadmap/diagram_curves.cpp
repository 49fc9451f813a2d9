// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "diagram_curves.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "best_first_search.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

DiagramNumber DiagramCurves::find(VoxelId id) const {
  const auto it = std::lower_bound(
      voxels.begin(), voxels.end(), layout->order_of(id),
      [&](VoxelId voxel, std::uint32_t order) { return layout->order_of(voxel) < order; });
  return it != voxels.end() && *it == id ? static_cast<DiagramNumber>(it - voxels.begin())
                                         : kNowhere;
}

DiagramCurves index_diagram(const EsdfMap& esdf, const VoxelMask& diagram, double min_clearance) {
  constexpr std::array<float, 4> kLengths{0.0f, 1.0f, 1.41421356f, 1.73205081f};
  const SquaredHalves threshold = least_clearance(min_clearance, esdf.voxel_size);
  const FreeSpace space(esdf);
  DiagramCurves curves;
  curves.layout = &esdf.layout;
  curves.voxels = diagram.members(esdf.layout);
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
          const SquaredHalves clearance = space.move_clearance(id, other, d);
          if (clearance < threshold) continue;
          moves[i].push_back({curves.find(other),
                              kLengths[static_cast<std::size_t>(squared_length(d))], clearance});
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
  struct Way {
    SquaredHalves width;
    float distance;
    DiagramNumber from;
    bool operator<(const Way& other) const {  // the widest is best, then the shortest
      return std::tie(other.width, distance, from) < std::tie(width, other.distance, other.from);
    }
  };
  BestFirstSearch<DiagramNumber, Way> search(curves.size(), {SquaredHalves(-1.0), 0.0f, kNowhere});
  DiagramFlood flood;
  flood.vertex.assign(curves.size(), kNowhere);
  flood.toward.assign(curves.size(), kNowhere);
  flood.width.assign(curves.size(), {});
  flood.distance.assign(curves.size(), 0.0f);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const DiagramNumber v = vertices[i];
    flood.vertex[v] = i;
    search.offer(v, {curves.squared[v], 0.0f, v}, v);
  }
  search.run([&](DiagramNumber voxel) {
    const Way way = search.cost(voxel);
    flood.toward[voxel] = way.from;
    flood.vertex[voxel] = flood.vertex[way.from];
    flood.width[voxel] = way.width;
    flood.distance[voxel] = way.distance;
    for (const DiagramMove& move : curves.moves_of(voxel))
      search.offer(move.to,
                   {std::min(way.width, move.clearance), way.distance + move.length, voxel}, voxel);
    return true;
  });
  return flood;
}

}  // namespace ridgeway::detail
