// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "mapping/memory_limit.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// How to place the voxels of a file while reading it.
struct VoxelPlacement {
  LatticeTransform motion;                       ///< from the file's voxels to the map's
  VoxelRange clip = kAllVoxels;                  ///< voxels of the map outside are not kept
  int bytes_per_voxel = kPipelineBytesPerVoxel;  ///< see memory_limit.hpp
};

}  // namespace ridgeway
