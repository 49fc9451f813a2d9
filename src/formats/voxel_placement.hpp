// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// How to place the voxels of a file while reading it.
struct VoxelPlacement {
  LatticeTransform motion;                       ///< from the file's lattice to the world's
  VoxelRange clip = kAllVoxels;                  ///< of the world's lattice; others are not kept
  int bytes_per_voxel = kPipelineBytesPerVoxel;  ///< to be reckoned with
};

}  // namespace ridgeway
