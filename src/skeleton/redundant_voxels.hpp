// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "esdf/remembered_space.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway::detail {

/// Deletes diagram voxels, lowest first, that are simple, end no curve, and whose neighbours stay
/// connected among themselves by legal moves that are at least as wide as those over the voxel.
/// Voxels at which ways end (`basins.next` is kCentre) stay.
void remove_redundant_voxels(const RememberedSpace& space, SquaredHalves threshold,
                             const Basins& basins, VoxelMask& diagram);

}  // namespace ridgeway::detail
