// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// The layout's blocks and all blocks 26-adjacent to them; of a planar map those in its plane.
BlockLayout with_neighbour_blocks(const BlockLayout& layout, bool planar);

/// Blocks that the sweeps have to pass through so that the distances of all of `target`'s voxels
/// are exact when only occupied voxels are obstacles. `occupied[slot]`: whether a target block
/// holds an obstacle; others hold none. `farthest`: bound of what is asked, voxels.
///
/// Why these suffice. Let o be the site of a target voxel t. The sweeps carry it from o along x to
/// (t.x, o.y, o.z), from there along y to (t.x, t.y, o.z), and along z to t. What they carry there
/// is o: of the obstacles of the plane z = o.z it is the nearest to (t.x, t.y, o.z), of those of
/// its row the nearest to (t.x, o.y, o.z), and ties go the same way at each sweep. What else they
/// carry in a smaller domain are obstacles too, so never nearer ones. It is enough, then, to hold
/// the blocks of these three runs for every target block and every block with obstacles that may
/// hold a site of its voxels, as far as a bound on their distance known by block allows: along x in
/// rows of blocks that hold obstacles, along y in planes that do, along z above and below target
/// blocks. None of them leaves the box around a target block and an obstacle, so none that around
/// `target`.
///
/// Throws InputError where memory would not do for `bytes_per_voxel` of so many blocks.
BlockLayout sweep_domain(const BlockLayout& target, const std::vector<bool>& occupied,
                         double farthest, int bytes_per_voxel);

}  // namespace ridgeway::detail
