// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "diagram_curves.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "best_first_search.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

namespace {

constexpr SquaredHalves kMeasuredByTheOther(-1.0);  // clearance that the move back has

/// A move to each neighbour in a diagram, its clearance known to the first of the two.
std::vector<DiagramMove> moves_to_neighbours(const RememberedSpace& space,
                                             const DiagramCurves& curves, DiagramNumber from,
                                             Cube27 neighbours) {
  constexpr std::array<float, 4> kLengths{0.0f, 1.0f, 1.41421356f, 1.73205081f};
  std::vector<DiagramMove> moves;
  const VoxelId id = curves.voxels[from];
  for (; neighbours != 0; neighbours &= neighbours - 1) {
    const int d = std::countr_zero(neighbours);
    const VoxelId other = curves.layout->neighbour(id, d);
    const DiagramNumber to = curves.find(other);
    moves.push_back({to, kLengths[static_cast<std::size_t>(squared_length(d))],
                     from < to ? space.move_clearance(id, other, d) : kMeasuredByTheOther});
  }
  return moves;
}

SquaredHalves clearance_of_move(const std::vector<DiagramMove>& moves, DiagramNumber to) {
  return std::find_if(moves.begin(), moves.end(),
                      [&](const DiagramMove& move) { return move.to == to; })
      ->clearance;
}

}  // namespace

DiagramNumber DiagramCurves::find(VoxelId id) const {
  if (id == kNoVoxel) return kNowhere;
  const std::uint32_t rank = layout->rank(id / kBlockVoxels);
  const auto first = voxels.begin() + first_of_block[rank];
  const auto last = voxels.begin() + first_of_block[rank + 1];
  const auto it = std::lower_bound(first, last, id);  // a block's are in the order of handles
  return it != last && *it == id ? static_cast<DiagramNumber>(it - voxels.begin()) : kNowhere;
}

DiagramCurves index_diagram(const EsdfMap& esdf, const VoxelMask& diagram, double min_clearance,
                            SegmentMemory* memory) {
  const SquaredHalves threshold = least_clearance(min_clearance, esdf.voxel_size);
  const RememberedSpace space(esdf, memory);
  DiagramCurves curves;
  curves.layout = &esdf.layout;
  curves.voxels = diagram.members(esdf.layout);
  curves.first_of_block.assign(esdf.layout.block_count() + 1, 0);
  for (const VoxelId id : curves.voxels)
    ++curves.first_of_block[esdf.layout.rank(id / kBlockVoxels) + 1];
  std::partial_sum(curves.first_of_block.begin(), curves.first_of_block.end(),
                   curves.first_of_block.begin());
  curves.squared.resize(curves.size());
  curves.position.resize(curves.size());
  std::vector<std::vector<DiagramMove>> moves(curves.size());
  parallel_for_each_index(
      curves.size(),
      [&](std::size_t i) {
        const VoxelId id = curves.voxels[i];
        curves.squared[i] = esdf.squared[id];
        curves.position[i] = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
        moves[i] = moves_to_neighbours(space, curves, static_cast<DiagramNumber>(i),
                                       cube_around(esdf.layout, diagram, id) & kCells26);
      },
      64);
  curves.first_move.push_back(0);
  for (DiagramNumber from = 0; from < curves.size(); ++from) {
    for (DiagramMove move : moves[from]) {
      if (move.clearance == kMeasuredByTheOther)
        move.clearance = clearance_of_move(moves[move.to], from);
      if (move.clearance >= threshold) curves.moves.push_back(move);
    }
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
