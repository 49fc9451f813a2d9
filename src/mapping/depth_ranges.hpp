// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway::detail {

/// A range beyond max_range, metres, cut to a truncation more than that: it says the same of the way
/// up to max_range, and what is measured has a voxel however far away it is.
inline double as_far_as_it_counts(double range, const FusionConfig& config) {
  return std::min(range, config.max_range + config.truncation);
}

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
