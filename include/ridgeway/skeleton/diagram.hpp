// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// Joins thinned edges and kernel to one diagram that is as wide as space itself: two of its
/// voxels are connected along it at a clearance exactly when they are in traversable space, at
/// every clearance. From high to low clearance, a piece that space connects at some level and the
/// diagram does not is joined along the way its voxels climb. Pieces of the edges that merely run
/// beside a curve of the diagram within two voxels are dropped. In the end no voxel is left that
/// could go without a loss: not simple, the end of a curve, or needed by the legal moves.
///
/// Redirects `basins.next` on the way: afterwards each voxel's way leads to the diagram, widest
/// first (a diagram voxel's own entry still climbs).
VoxelMask join_diagram(const EsdfMap& esdf, const VoxelMask& edges, const VoxelMask& kernel,
                       double min_clearance, Basins& basins);

}  // namespace ridgeway
