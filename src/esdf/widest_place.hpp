// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// The voxel that is farthest from obstacles, of those where a robot's centre may be.
struct WidestPlace {
  Point place;             ///< metres, world frame
  double clearance = 0.0;  ///< metres; infinite without any obstacle
};

/// The first in the order of voxels (z, y, x) of several that are as wide; nothing where a centre
/// may be nowhere. Looks at every voxel.
std::optional<WidestPlace> widest_place(const EsdfMap& esdf);

}  // namespace ridgeway::detail
