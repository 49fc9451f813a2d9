// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// Whether a neighbourhood matches one of the deletion templates of She et al. 2009 (paper:
/// Thinning) in any orientation: A face, B edge, C corner, D in-plane diagonal.
bool matches_deletion_template(Cube27 cube);

/// Thins a set to curves and keeps its topology: b0, b1 and b2 stay. Voxels that match a template,
/// are simple and end no curve go, layer by layer; at last any simple voxel that ends no curve, so
/// that the result is one voxel wide. Eight parity sub-fields, in which no two voxels are
/// adjacent, make it parallel with the same result for any number of threads.
void thin(const BlockLayout& layout, VoxelMask& voxels);

}  // namespace ridgeway
