// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <vector>

#include "deadline.hpp"
#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

enum class SearchStatus : std::uint8_t { kFound, kNoRoute, kTimeout };

struct LatticePath {
  SearchStatus status = SearchStatus::kNoRoute;
  std::vector<VoxelId> voxels;  ///< start first, goal last
  double cost = std::numeric_limits<double>::infinity();  ///< length, voxels
};

/// A* over legal 26-moves between voxels that are free at a radius, Euclidean costs, with the
/// lattice's own distance as heuristic. Buckets instead of a heap. `within`:
/// only voxels of this set, null for all. Start and goal must be traversable voxels.
/// Memory follows the blocks that are visited.
LatticePath search_lattice(const EsdfMap& esdf, VoxelId start, VoxelId goal, double radius,
                           const VoxelMask* within, const Deadline& deadline);

}  // namespace ridgeway::detail
