// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// The voxels nearest to the corners of a tight path, in its order, each as far from obstacles as
/// the corner at least.
using CornerChain = std::vector<VoxelId>;

/// Corners of tight paths between random pairs of places: of the graph's shortest route and of
/// another way round. Deterministic; the smallest radius.
std::vector<CornerChain> sample_corners(const Roadmap& roadmap, std::size_t pairs);

}  // namespace ridgeway::detail
