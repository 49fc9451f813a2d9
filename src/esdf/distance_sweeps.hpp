// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Of each voxel of a layout: 4 d^2 / s^2 to the nearest obstacle cube, and the offset to it.
/// Obstacles have 0 and {0,0,0}; a voxel without an obstacle in reach has kNoSite and an offset of
/// no meaning.
struct NearestSites {
  VoxelField<std::uint32_t> squared;
  SiteField offset;
};

/// Exact distances by one sweep along each axis, x first (method: Felzenszwalb and Huttenlocher,
/// "Distance Transforms of Sampled Functions", 2012, with the distance to cubes in place of
/// points); ties go to the site that is smallest in (z, y, x). Distances above kFarthestSite, or
/// above `farthest` voxels, are too long or missing. `solid_outside`: whether voxels that the
/// layout does not hold are obstacles. `planar`: distances count along x and y alone.
///
/// Plain form: plain_nearest() in plain_distances.hpp, for each voxel. From it,
/// docs/fast-kernels.md section 1: one axis at a time (1), runs between obstacles alone (2), gaps
/// (3), the range of sites (7), and for each run line_envelope.hpp.
NearestSites sweep_distances(const BlockLayout& layout, const VoxelMask& obstacle,
                             bool solid_outside, bool planar = false,
                             double farthest = std::numeric_limits<double>::infinity());

}  // namespace ridgeway::detail
