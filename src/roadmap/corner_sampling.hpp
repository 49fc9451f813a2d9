// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// A tight path between two voxels.
struct SampledPath {
  std::size_t pair = 0;  ///< number of the two
  VoxelId from = kNoVoxel, to = kNoVoxel;
  std::uint32_t part = 0;  ///< connected part of the graph that it went over
  std::vector<Point> waypoints;
};

/// Of a pair of places: the path by the graph's shortest route, or by another way round.
enum class SampledRoutes { kShortest, kOther, kBoth };

/// Tight paths between random pairs of places, by the number of the pair. Pairs that see each other
/// have none. Deterministic; for the smallest radius.
std::vector<SampledPath> sample_paths(const Roadmap& roadmap, std::size_t first_pair,
                                      std::size_t pairs, SampledRoutes routes);

}  // namespace ridgeway::detail
