// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "live_field.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/thinning_memory.hpp"

namespace ridgeway::detail {

/// The ridges of a field that changes, as the stages from traversable_voxels to thin() leave them.
struct LiveRidges {
  double radius = 0.0;  ///< metres; of what is traversable
  GvdConfig config = {};
  VoxelMask traversable = {}, gvd = {}, thick_edges = {}, edges = {};
  std::size_t traversable_count = 0, gvd_count = 0, thick_count = 0;
  /// Those that came or went with the last update.
  MarkedVoxels changed_space = {}, changed_gvd = {}, changed_thick = {};
  ThinningMemory thinning = {};
};

/// The blocks of marked voxels and of their 26-neighbours, ascending.
std::vector<std::uint32_t> blocks_around(const BlockLayout& layout, const MarkedVoxels& marked);

/// What is traversable follows a field after update_distances: blocks in which something has
/// changed. Where unknown space is an obstacle.
void update_traversable(LiveRidges& ridges, const LiveField& field);

/// And after that the rest: blocks in which something has changed, and those beside it; of the
/// thinned edges those voxels that are to be asked otherwise than before.
void update_edges(LiveRidges& ridges, const LiveField& field);

}  // namespace ridgeway::detail
