// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "live_ridges.hpp"
#include "skeleton/watershed.hpp"
#include "space_parts.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {

/// The watershed of a field that changes. A basin keeps its number for as long as its peak is one.
struct LiveBasins {
  LocalWays ways = {};
  std::vector<Cube27> exits = {};   ///< by block: the directions of blocks that its ways lead to
  std::vector<VoxelId> peaks = {};  ///< by number; kNoVoxel for one that no basin has
  /// By block, of the critical voxels those that may join two basins.
  std::vector<std::vector<CriticalVoxel>> saddles = {};
  BasinJoins joins = {};
  SpaceParts parts = {};
  std::vector<std::uint32_t> unused = {};  ///< those numbers
  FlatTable<VoxelId, std::uint32_t> number_of_peak = {};
};

/// Follows a field after update_traversable: ways and peaks in blocks in which a distance has
/// changed and those beside them, numbers also where ways lead to voxels whose basin became
/// another.
void update_basins(LiveBasins& basins, BasinNumbers& numbers, const LiveField& field,
                   const LiveRidges& ridges);

/// As find_watershed of some 26-connected parts of what is traversable, `among`, but for the order
/// of the numbers, and of the critical voxels only those that may join two basins. `next`: that of
/// `basins` there.
Watershed watershed_of(const LiveBasins& basins, BasinNumbers numbers, VoxelField<Direction> next,
                       const LiveField& field, const VoxelMask& among);

}  // namespace ridgeway::detail
