// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// A tight path between two voxels.
struct SampledPath {
  VoxelId from = kNoVoxel, to = kNoVoxel;
  std::uint32_t part = 0;  ///< connected part of the graph that it went over
  std::vector<Point> waypoints;
};

/// Tight paths by the graph's shortest routes between random pairs of places, by the number of the
/// pair. Pairs that see each other have none. Deterministic; for the smallest radius.
std::vector<SampledPath> sample_paths(const Roadmap& roadmap, std::size_t first_pair,
                                      std::size_t pairs);

}  // namespace ridgeway::detail
