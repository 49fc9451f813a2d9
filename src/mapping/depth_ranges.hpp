// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/sensing/depth_camera.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway::detail {

/// A depth image in two of the same size, each 0 where a pixel is of the other or measures nothing.
struct DepthRanges {
  DepthImage within;  ///< what is in range: surfaces
  DepthImage beyond;  ///< what is farther than max_range: the way up to there is free. Without
                      ///< carving there is none
};

/// A pixel whose neighbours measure nothing beyond the range is taken for noise, and frees nothing.
DepthRanges ranges_of(const DepthImage& image, const PinholeCamera& camera,
                      const FusionConfig& config);

}  // namespace ridgeway::detail
