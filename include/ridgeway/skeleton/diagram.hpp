// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// Joins thinned edges and kernel to one diagram along which space is connected as widely as it is.
///
/// First the kernel is made exact: from high to low clearance, wherever space connects two of its
/// pieces and the kernel does not, the way over the pass is added. Then the pieces of the edges
/// are hooked on: a piece that within one voxel of clearance below its top meets nothing gets the
/// way its top climbs; pieces that merely run beside a curve within two voxels are dropped. In the
/// end no voxel is left that could go without a loss: that is not simple, the end of a curve, or
/// needed by the legal moves.
///
/// Redirects `basins.next` on the way: afterwards each voxel's way leads to the diagram, widest
/// first (a diagram voxel's own entry still climbs on).
VoxelMask join_diagram(const EsdfMap& esdf, const VoxelMask& edges, const VoxelMask& kernel,
                       double min_clearance, Basins& basins);

}  // namespace ridgeway
