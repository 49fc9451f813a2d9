// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway::detail {

/// Thinning asks all voxels twice: whether they match a deletion template, then without templates.
inline constexpr std::uint32_t kThinningPasses = 2;

/// Whether a voxel may be deleted in a pass (0 or 1), by what is there around it.
bool may_be_thinned(std::uint32_t pass, Cube27 cube);

/// Told after each round of a pass: which voxels were deleted in it.
using ThinningRound = std::function<void(std::uint32_t pass, std::uint32_t round,
                                         const std::vector<VoxelId>& deleted)>;

/// What thin() does, of some members of the set: whole 26-components of it. Components do not see
/// each other.
void thin_among(const BlockLayout& layout, VoxelMask& voxels, std::vector<VoxelId> among,
                const ThinningRound& told = {});

}  // namespace ridgeway::detail
