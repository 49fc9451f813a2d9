// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {

/// Sets of voxels of one block, a bit for each: operations take a few instructions a layer.
using BlockMask = VoxelMask::Block;

inline BlockMask difference(const BlockMask& a, const BlockMask& b) {
  BlockMask mask;
  for (std::size_t z = 0; z < mask.size(); ++z) mask[z] = a[z] ^ b[z];
  return mask;
}

/// Whether all members of a set are in another.
inline bool is_within(const BlockMask& set, const BlockMask& other) {
  for (std::size_t z = 0; z < set.size(); ++z)
    if ((set[z] & ~other[z]) != 0) return false;
  return true;
}

/// The voxels of a block that have a state; all of them are unknown where there is no block.
BlockMask mask_of(const EsdfMap& esdf, const BlockIndex& block, VoxelState state);

/// Those that lie in a range of the map's own voxels.
BlockMask mask_within(const BlockIndex& block, const VoxelIndex& min, const VoxelIndex& max);

/// The voxels of the block one step further, a step along each axis or none, that touch voxels of a
/// set, a corner at least. Step (0, 0, 0): the set and all that touch it.
BlockMask touched_by(const BlockMask& mask, const VoxelIndex& step);

/// Voxels of a block whose neighbour across a face is a member: of `own`, or of the block beyond.
BlockMask beside(const BlockMask& own, const BlockMask& beyond, Direction face);

/// Whether voxels of a set lie at a face of their block.
bool reaches(const BlockMask& mask, Direction face);

/// The piece of a set, connected over 26 neighbours, that holds its first member.
BlockMask first_piece(const BlockMask& mask);

}  // namespace ridgeway::detail
