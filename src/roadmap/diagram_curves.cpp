// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "diagram_curves.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "best_first_search.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {

namespace {

constexpr SquaredHalves kMeasuredByTheOther(-1.0);  // clearance that the move back has

/// Number of a diagram voxel, by how many of its block come before it.
DiagramNumber number_of(const DiagramCurves& curves, const VoxelMask& diagram, VoxelId id) {
  return curves.first_of_block[curves.layout->rank(id / kBlockVoxels)] +
         static_cast<DiagramNumber>(members_before(diagram.block(id / kBlockVoxels), id));
}

/// A move to each neighbour in a diagram, its clearance known to the first of the two.
void find_moves(const RememberedSpace& space, const VoxelMask& diagram, DiagramNumber from,
                Cube27 neighbours, DiagramCurves& curves) {
  constexpr std::array<float, 4> kLengths{0.0f, 1.0f, 1.41421356f, 1.73205081f};
  const VoxelId id = curves.voxels[from];
  for (std::size_t move = curves.first_move[from]; neighbours != 0;
       ++move, neighbours &= neighbours - 1) {
    const int d = std::countr_zero(neighbours);
    const VoxelId other = curves.layout->neighbour(id, d);
    const DiagramNumber to = number_of(curves, diagram, other);
    curves.moves[move] = {to, kLengths[static_cast<std::size_t>(squared_length(d))],
                          from < to ? space.move_clearance(id, other, d) : kMeasuredByTheOther};
  }
}

/// Gives the moves from a voxel the clearances that the others have measured.
void take_clearances(DiagramNumber from, DiagramCurves& curves) {
  for (std::size_t i = curves.first_move[from]; i < curves.first_move[from + 1]; ++i) {
    DiagramMove& move = curves.moves[i];
    if (move.to > from) continue;
    const std::span<const DiagramMove> others = curves.moves_of(move.to);
    move.clearance = std::find_if(others.begin(), others.end(), [&](const DiagramMove& other) {
                       return other.to == from;
                     })->clearance;
  }
}

/// Drops the moves that are narrower than a threshold.
void drop_narrow_moves(SquaredHalves threshold, DiagramCurves& curves) {
  std::uint32_t kept = 0, first = 0;
  for (DiagramNumber from = 0; from < curves.size(); ++from) {
    const std::uint32_t last = curves.first_move[from + 1];
    for (std::uint32_t i = first; i < last; ++i)
      if (curves.moves[i].clearance >= threshold) curves.moves[kept++] = curves.moves[i];
    curves.first_move[from + 1] = kept;
    first = last;
  }
  curves.moves.resize(kept);
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
  curves.voxel_size = esdf.voxel_size;
  curves.voxels = diagram.members(esdf.layout);
  curves.first_of_block.assign(esdf.layout.block_count() + 1, 0);
  for (const VoxelId id : curves.voxels)
    ++curves.first_of_block[esdf.layout.rank(id / kBlockVoxels) + 1];
  std::partial_sum(curves.first_of_block.begin(), curves.first_of_block.end(),
                   curves.first_of_block.begin());
  curves.squared.resize(curves.size());
  std::vector<Cube27> neighbours(curves.size());
  curves.first_move.assign(curves.size() + 1, 0);
  parallel_for_each_index(
      curves.size(),
      [&](std::size_t i) {
        const VoxelId id = curves.voxels[i];
        curves.squared[i] = esdf.squared[id];
        neighbours[i] = cube_around(esdf.layout, diagram, id) & kCells26;
        curves.first_move[i + 1] = static_cast<std::uint32_t>(bit_count(neighbours[i]));
      },
      64);
  std::partial_sum(curves.first_move.begin(), curves.first_move.end(), curves.first_move.begin());
  curves.moves.resize(curves.first_move.back());
  parallel_for_each_index(
      curves.size(),
      [&](std::size_t i) {
        find_moves(space, diagram, static_cast<DiagramNumber>(i), neighbours[i], curves);
      },
      64);
  parallel_for_each_index(
      curves.size(), [&](std::size_t i) { take_clearances(static_cast<DiagramNumber>(i), curves); },
      256);
  drop_narrow_moves(threshold, curves);
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
