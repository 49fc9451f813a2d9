// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// A voxel that went later than at its first turn: in which round of which level.
struct LateVoxel {
  VoxelId id;
  std::uint32_t level, round;
};

/// Deletes simple voxels, those of `keep` apart, level of 4 d^2 / s^2 by level from the lowest up,
/// until only what carries the topology is left. A level and what the ones below have left is
/// peeled in rounds; in the first round the level's own voxels are asked, later the neighbours of
/// deleted ones, each round sub-field by sub-field.
/// `not_simple`: those that do not go at their first turn even if all their neighbours with earlier
/// turns went. `late`: where to note those that go, but not at their first turn.
VoxelMask peel_levels(const EsdfMap& esdf, const VoxelMask& traversable, VoxelMask not_simple,
                      const VoxelMask& keep, std::vector<LateVoxel>* late = nullptr);

}  // namespace ridgeway::detail
