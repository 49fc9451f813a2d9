// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/map_transform.hpp"
#include "ridgeway/mapping/memory_limit.hpp"
#include "ridgeway/mapping/voxel_range.hpp"

namespace ridgeway {

/// How to place the voxels of a file while reading it.
struct VoxelPlacement {
  LatticeTransform motion;                       ///< from the file's voxels to the map's
  VoxelRange clip = kAllVoxels;                  ///< voxels of the map outside are not kept
  int bytes_per_voxel = kPipelineBytesPerVoxel;  ///< see memory_limit.hpp
};

}  // namespace ridgeway
