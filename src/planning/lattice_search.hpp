// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <vector>

#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "roadmap/cell_guide.hpp"

namespace ridgeway::detail {

enum class SearchStatus : std::uint8_t { kFound, kNoRoute, kTimeout };

struct LatticePath {
  SearchStatus status = SearchStatus::kNoRoute;
  std::vector<VoxelId> voxels;                            ///< start first, goal last
  double cost = std::numeric_limits<double>::infinity();  ///< length, voxels
};

/// How a lattice is searched.
struct LatticeOptions {
  const VoxelMask* within = nullptr;  ///< only voxels of this set
  /// Ways to the goal: estimates from there on, and only voxels of parts of cells that have
  /// one: then the path need not be the shortest.
  const CellGuide* guide = nullptr;
  double longest = std::numeric_limits<double>::infinity();  ///< paths of interest, voxels
  /// After these the best so far, or kNoRoute, which then says nothing about space.
  int most_expansions = std::numeric_limits<int>::max();
};

/// A* over legal 26-moves between voxels that are free at a radius and within the limits, Euclidean
/// costs, with the lattice's own distance as heuristic. Buckets instead of a heap. Start and goal
/// must be traversable voxels. Memory follows the blocks visited.
LatticePath search_lattice(const FreeSpace& space, VoxelId start, VoxelId goal, double radius,
                           const LatticeOptions& options, const Deadline& deadline);

}  // namespace ridgeway::detail
