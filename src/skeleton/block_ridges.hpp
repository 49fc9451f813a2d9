// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/skeleton/gvd.hpp"

/// What ridgeway/skeleton/gvd.hpp computes of a map, of one of its blocks.
namespace ridgeway::detail {

/// Goes by the block alone.
VoxelMask::Block traversable_in_block(const EsdfMap& esdf, double radius, std::uint32_t slot,
                                      bool within_limits = true);

/// Goes by the states and sites of the block's voxels and of their 6-neighbours. The configuration
/// must be valid.
VoxelMask::Block gvd_in_block(const EsdfMap& esdf, const VoxelMask& traversable,
                              const GvdConfig& config, std::uint32_t slot);

/// Goes by the GVD in the block and around its voxels.
VoxelMask::Block edges_in_block(const BlockLayout& layout, const VoxelMask& gvd,
                                std::uint32_t slot);

}  // namespace ridgeway::detail
