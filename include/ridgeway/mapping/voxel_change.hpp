// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// A voxel of the lattice, and the state that it now has.
struct VoxelChange {
  VoxelIndex voxel;
  VoxelState state = VoxelState::kUnknown;

  friend bool operator==(const VoxelChange&, const VoxelChange&) = default;
};

}  // namespace ridgeway
