// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"
#include "sub_field.hpp"

namespace ridgeway::detail {

/// The neighbours of a voxel in a set by their levels (4 d^2 / s^2).
struct LevelNeighbours {
  Cube27 higher = 0;
  Cube27 equal = 0;

  /// Those whose first turn comes after the voxel's own. No two voxels with the same level and
  /// sub-field are adjacent.
  Cube27 later(VoxelId id) const { return higher | (equal & kLaterFields[id % kBlockVoxels]); }
};

inline LevelNeighbours neighbours_by_level(const EsdfMap& esdf, const VoxelMask& voxels,
                                           VoxelId id) {
  const std::uint32_t own = esdf.squared[id];
  LevelNeighbours around;
  for (Cube27 cells = cube_around(esdf.layout, voxels, id) & kCells26; cells != 0;
       cells &= cells - 1) {
    const Cube27 cell = cells & (~cells + 1);
    const std::uint32_t level = esdf.squared[esdf.layout.neighbour(id, std::countr_zero(cells))];
    if (level > own) around.higher |= cell;
    if (level == own) around.equal |= cell;
  }
  return around;
}

}  // namespace ridgeway::detail
