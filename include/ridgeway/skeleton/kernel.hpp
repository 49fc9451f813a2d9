// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway {

/// Homotopic kernel of a set: deletes simple voxels in ascending order of clearance until only
/// what carries the topology is left (same b0, b1, b2), along the widest ways. Peaks of the
/// clearance that rise at least one voxel above their pass stay. Levels of equal d^2 are peeled
/// layer by layer in sub-fields: the same result for any number of threads.
VoxelMask compute_kernel(const EsdfMap& esdf, const VoxelMask& traversable, const Basins& basins);

/// Replaces shells and sheets of a thin set by the curves along their ridges of clearance: each
/// sheet is pierced where it is nearest to an obstacle, the hole grows up to the ridges. b0 stays,
/// b2 becomes zero, b1 never falls. Voxels of `keep` and ends of curves stay.
void open_shells(const EsdfMap& esdf, VoxelMask& voxels, const VoxelMask& keep);

/// Peaks with dynamics of at least one voxel.
VoxelMask significant_peaks(const EsdfMap& esdf, const Basins& basins);

}  // namespace ridgeway
