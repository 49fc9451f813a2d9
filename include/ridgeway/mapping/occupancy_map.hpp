// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <optional>

#include "ridgeway/voxel/block_layout.hpp"
#include "ridgeway/voxel/voxel_field.hpp"

namespace ridgeway {

/// What a map knows of a voxel.
enum class VoxelState : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2 };

/// An axis-aligned box, metres, world frame, min <= max in every axis.
struct Box {
  Point min = Point::Zero();
  Point max = Point::Zero();
};

/// Voxel states on sparse blocks. Voxels of blocks that are not allocated are unknown.
/// Invariant: `state` has one value for every voxel of `layout`; voxel_size > 0 and finite; no
/// known voxel lies farther than 1e9 voxels from the world's zero.
/// What makes maps of files, of worlds and of other maps puts the origin at the lowest known voxel
/// of each axis (normalised, mapping/occupancy_builder.hpp): then a map that is moved by whole
/// voxels is the same but for its origin, and so is all that is made of it.
struct OccupancyMap {
  double voxel_size = 0.0;  ///< metres
  VoxelIndex origin = {};   ///< the lattice's voxel that is the map's own (0, 0, 0)
  BlockLayout layout;       ///< of the map's own voxels
  VoxelField<VoxelState> state;

  /// Of one of the map's own voxels.
  VoxelState at(const VoxelIndex& voxel) const {
    const VoxelId id = layout.find(voxel);
    return id == kNoVoxel ? VoxelState::kUnknown : state[id];
  }
};

/// How many voxels are in each state; `unknown` counts allocated blocks only.
struct VoxelCounts {
  std::size_t free = 0;
  std::size_t occupied = 0;
  std::size_t unknown = 0;
  std::size_t known() const { return free + occupied; }
};
VoxelCounts count_voxels(const OccupancyMap& map);

/// Box around all known voxels, in the world, or nothing where none is known.
std::optional<Box> known_bounds(const OccupancyMap& map);

}  // namespace ridgeway
