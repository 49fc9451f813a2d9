// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "voxel_look.hpp"

namespace ridgeway::detail {

/// A voxel in which an image has a surface, and of which the pixel that sees its centre says
/// otherwise: it looks past what is thin.
struct MissedSurface {
  BlockIndex block;
  int voxel = 0;  ///< in the block
  VoxelLook::Measured measured;
};

/// Each voxel once, by block and then by voxel: with the surface that is nearest to its centre.
/// `raw`: the image as it was measured; where noise has moved a depth much, it counts for nothing.
std::vector<MissedSurface> missed_surfaces(const VoxelLook& look, const DepthImage& raw,
                                           const Eigen::Isometry3d& T_map_camera,
                                           const FusionConfig& config);

}  // namespace ridgeway::detail
