// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"
#include "voxel/disjoint_sets.hpp"

/// What watershed.cpp and basins.cpp compute, voxel by voxel and move by move, for tests.
/// docs/fast-kernels.md derives these from it.
namespace ridgeway::detail {

/// Whether a voxel is above another in the total order of heights: by distance, of equal ones
/// that which is earlier in the order of blocks and then of places in a block.
inline bool is_above(const EsdfMap& esdf, VoxelId a, VoxelId b) {
  if (esdf.squared[a] != esdf.squared[b]) return esdf.squared[a] > esdf.squared[b];
  const auto place = [&](VoxelId id) {
    return std::pair(esdf.layout.block(id / kBlockVoxels), id % kBlockVoxels);
  };
  return place(a) < place(b);
}

/// The traversable neighbours of a voxel for which holds(neighbour, direction) is true.
template <typename Holds>
Cube27 plain_neighbours(const EsdfMap& esdf, const VoxelMask& traversable, VoxelId id,
                        const Holds& holds) {
  Cube27 cube = 0;
  for (int d = 0; d < 27; ++d) {
    const VoxelId n = esdf.layout.neighbour(id, d);
    if (d != kCentre && n != kNoVoxel && traversable.test(n) && holds(n, d)) cube |= 1u << d;
  }
  return cube;
}

/// The direction in which a voxel climbs: of the moves to voxels above it that cannot dip (those
/// across a face, and others that rise by 4 for each squared voxel of their length or more) the
/// steepest, of equally steep ones the first; kCentre where there is none.
inline Direction plain_climb(const EsdfMap& esdf, const VoxelMask& traversable, VoxelId id) {
  Direction best = kCentre;
  double steepest = -1.0;  // squared
  plain_neighbours(esdf, traversable, id, [&](VoxelId n, int d) {
    if (!is_above(esdf, n, id)) return false;
    const double rise = esdf.squared[n] - esdf.squared[id], length = squared_length(d);
    if (length > 1.0 && rise < 4.0 * length) return false;
    if (rise * rise / length > steepest) {
      steepest = rise * rise / length;
      best = static_cast<Direction>(d);
    }
    return true;
  });
  return best;
}

/// How far every peak that rises above its pass to a higher peak does so, voxels, ascending:
/// Kruskal over all moves of all voxels, the widest first, where of two regions that meet the one
/// with the lower peak ends. Infinite for the highest peak of each component.
inline std::vector<double> plain_dynamics(const EsdfMap& esdf, const VoxelMask& traversable,
                                          SquaredHalves threshold) {
  struct Move {
    SquaredHalves clearance;
    VoxelId from, to;
  };
  const FreeSpace space(esdf);
  std::vector<Move> moves;
  std::vector<double> dynamics;
  DisjointSets regions(esdf.layout.voxel_count());
  const std::vector<std::uint32_t> levels = esdf.squared.values();
  std::vector<double> peak(levels.begin(), levels.end());
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (traversable.test(id))
      plain_neighbours(esdf, traversable, id, [&](VoxelId n, int d) {
        if (d <= kCentre) return true;  // each move from one of its ends
        const SquaredHalves clearance = space.move_clearance(id, n, d);
        if (clearance >= threshold) moves.push_back({clearance, id, n});
        return true;
      });
  std::sort(moves.begin(), moves.end(),
            [](const Move& a, const Move& b) { return a.clearance > b.clearance; });
  for (const Move& move : moves) {
    const std::uint32_t a = regions.find(move.from), b = regions.find(move.to);
    if (a == b) continue;
    const double lower = std::min(peak[a], peak[b]), higher = std::max(peak[a], peak[b]);
    if (lower > move.clearance.value)
      dynamics.push_back(0.5 * (std::sqrt(lower) - std::sqrt(move.clearance.value)));
    peak[regions.join(a, b)] = higher;
  }
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
    if (traversable.test(id) && regions.find(id) == id)
      dynamics.push_back(std::numeric_limits<double>::infinity());
  std::sort(dynamics.begin(), dynamics.end());
  return dynamics;
}

}  // namespace ridgeway::detail
