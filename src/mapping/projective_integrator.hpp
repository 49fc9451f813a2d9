// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "depth_ranges.hpp"
#include "depth_surfaces.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway::detail {

/// Updates every voxel that a pixel of an image sees. `surfaces` are those within the range.
void integrate_projective(const DepthSurfaces& surfaces, const DepthRanges& ranges,
                          const PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                          const FusionConfig& config, TsdfBlocks& blocks);

}  // namespace ridgeway::detail
