// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "esdf/remembered_space.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway::detail {

/// Adds to a kernel the ways that make it exact: two of its voxels are then connected along it at
/// a clearance exactly when they are in space, at every clearance. Redirects `basins.next` so that
/// every way leads to it, widest first. `threshold`: least_clearance of the smallest clearance.
VoxelMask join_kernel(const RememberedSpace& space, const VoxelMask& kernel,
                      SquaredHalves threshold, Basins& basins);

}  // namespace ridgeway::detail
