// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway::detail {

/// How much a measurement of the distance `value` counts: less far from the surface, where another
/// surface that this ray did not see may be nearer (every measurement bounds the distance from
/// above), and nothing at the depth behind it where nobody looked.
inline float gain_of(float value, const FusionConfig& config) {
  constexpr float kCarving = 0.005f;  // of a look at the surface itself
  if (value > 0.0f) return std::max(1.0f - value / static_cast<float>(config.truncation), kCarving);
  return std::max(1.0f + value / static_cast<float>(config.depth_behind), 0.0f);
}

/// Updates every voxel that a pixel of an image sees. Depths outside the range limits are 0
/// already.
void integrate_projective(const DepthImage& image, const PinholeCamera& camera,
                          const Eigen::Isometry3d& T_world_camera, const FusionConfig& config,
                          TsdfBlocks& blocks);

}  // namespace ridgeway::detail
