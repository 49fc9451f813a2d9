// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway::detail {

/// A measured point of a surface, in the map's own frame.
struct SurfacePoint {
  Point position;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< towards the sensor; zero: not known
  bool is_beyond = false;                            ///< farther than max_range
};

/// Updates the voxels on the rays from a sensor to points and a truncation beyond. Points in one
/// voxel are taken together. To a point beyond max_range, the way up to there alone is
/// updated. Each block gathers its rays in one fixed order.
void integrate_rays(const std::vector<SurfacePoint>& points, const Point& sensor,
                    const FusionConfig& config, TsdfBlocks& blocks);

}  // namespace ridgeway::detail
