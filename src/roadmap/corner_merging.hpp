// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <utility>
#include <vector>

#include "corner_sampling.hpp"

namespace ridgeway::detail {

/// Corners, and which of them follow each other on a path.
struct MergedCorners {
  std::vector<VoxelId> voxels;                                 ///< ascending
  std::vector<std::pair<std::uint32_t, std::uint32_t>> steps;  ///< smaller first, ascending
};

/// One corner for those that lie within a distance of each other and can stand for each other:
/// paths over them stay free.
MergedCorners merge_corners(const Roadmap& roadmap, const std::vector<CornerChain>& chains,
                            double distance);

}  // namespace ridgeway::detail
