// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway::detail {

/// What thin() does, of some members of the set: whole 26-components of it. Components do not see
/// each other.
void thin_among(const BlockLayout& layout, VoxelMask& voxels, std::vector<VoxelId> among);

}  // namespace ridgeway::detail
