// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/exploration/explorer.hpp"

namespace ridgeway::detail {

/// How many unknown voxels a look from a place (local frame) at a yaw is expected to measure. Rays
/// over the field of view pass known-free and unknown voxels of `within` up to an obstacle or the
/// range. Each metre of unknown space that a ray passes makes it less likely that it gets on, and
/// the farther off a voxel is, the rarer there is a surface behind it that is in range. The field's
/// obstacles must include unknown space.
double expected_voxels(const EsdfMap& esdf, const FieldOfView& view, const VoxelRange& within,
                       const Point& from, double yaw);

}  // namespace ridgeway::detail
