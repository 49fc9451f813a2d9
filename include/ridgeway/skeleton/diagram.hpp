// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// Removes voxels so that nothing floats in what is left: each part of the background is joined
/// with another one by an arc where the two are nearest, from obstacle to obstacle one voxel wide.
/// b0 and b1 stay, b2 becomes zero, but where an arc cannot be without a change to b0 or b1 (hardly
/// anywhere; parts beyond max_distance). `not_simple`: Basins::not_simple_at_first_turn of the
/// voxels, kept so.
void join_background(const EsdfMap& esdf, VoxelMask& voxels, VoxelMask& not_simple);

/// Homotopic kernel of a set: deletes simple voxels in ascending order of clearance until only
/// what carries the topology is left (same b0, b1, b2), along the widest ways. Peaks of the
/// clearance that rise at least one voxel above their pass stay. Levels of equal d^2 are peeled
/// layer by layer in sub-fields: the same result for any number of threads.
VoxelMask compute_kernel(const EsdfMap& esdf, const VoxelMask& traversable, const Basins& basins);

/// Replaces shells and sheets of a thin set by the curves along their ridges of clearance: each
/// sheet is pierced where it is nearest to an obstacle, the hole grows up to the ridges. b0 stays,
/// b2 becomes zero, b1 never falls. Voxels of `keep` and ends of curves stay.
void open_shells(const EsdfMap& esdf, VoxelMask& voxels, const VoxelMask& keep);

/// Peaks with dynamics of at least one voxel, of those that are in `voxels`: join_background may
/// have removed some.
VoxelMask significant_peaks(const EsdfMap& esdf, const Basins& basins, const VoxelMask& voxels);

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
/// first (a diagram voxel's own entry still climbs on). `kernel`: as compute_kernel gives it, with
/// a voxel at least in every part of space. `min_clearance`: the smallest radius, metres; that of
/// the basins.
VoxelMask join_diagram(const EsdfMap& esdf, const VoxelMask& edges, const VoxelMask& kernel,
                       double min_clearance, Basins& basins);

}  // namespace ridgeway
