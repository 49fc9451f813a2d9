// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway::detail {

/// The layout's blocks and all blocks 26-adjacent to them.
BlockLayout with_neighbour_blocks(const BlockLayout& layout);

/// Blocks that the sweeps have to pass through so that the distances of all of `target`'s voxels
/// are exact when only occupied voxels are obstacles: the way from a voxel to its nearest site
/// stays in the box between them, and a bound on that distance is known block by block.
/// `occupied[slot]`: whether a target block holds an obstacle. `farthest`: bound, voxels.
BlockLayout sweep_domain(const BlockLayout& target, const std::vector<bool>& occupied,
                         double farthest);

}  // namespace ridgeway::detail
