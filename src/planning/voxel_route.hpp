// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "route.hpp"

namespace ridgeway::detail {

/// Start, the lattice voxels (bends only), goal.
Route route_over_voxels(const EsdfMap& esdf, const RouteQuery& query,
                        const std::vector<VoxelId>& voxels);

/// Joins two ways that end on the same voxel at the first voxel that they share.
std::vector<VoxelId> join_ways(std::vector<VoxelId> a, std::vector<VoxelId> b);

}  // namespace ridgeway::detail
