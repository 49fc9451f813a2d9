// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

enum class EndpointStatus : std::uint8_t {
  kOk,
  kOutsideMap,
  kUnknown,
  kInCollision,
  kOutsideLimits
};

/// Where a point joins the voxel lattice.
struct Endpoint {
  EndpointStatus status = EndpointStatus::kOutsideMap;
  VoxelId voxel = kNoVoxel;
};

/// The nearest traversable voxel centre, of the point's voxel and its 26 neighbours, that a
/// straight free segment leads to; where there is none, of those up to three voxels off in each
/// direction. The same function serves every planner.
Endpoint find_endpoint(const FreeSpace& space, const Point& point, double radius);

}  // namespace ridgeway::detail
