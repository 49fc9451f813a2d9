// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/exploration/frontiers.hpp"

namespace ridgeway::detail {

/// Whether the straight line from a point to the centre of a voxel passes known-free voxels alone,
/// that voxel itself apart. Local frame. Skips through free space by the distances of the field,
/// whose obstacles must include unknown space.
bool sees(const EsdfMap& esdf, const Point& from, const VoxelIndex& target);

/// How many unknown voxels lie behind a part of the frontier, along its normal and up to so many
/// metres, one at least: its volume is about as many times its voxels.
double depth_behind(const EsdfMap& esdf, const VoxelRange& within, const FrontierPart& part,
                    double most);

}  // namespace ridgeway::detail
