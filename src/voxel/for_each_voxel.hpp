// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway::detail {

/// Calls body(id) for every voxel of a layout, the blocks in parallel and in any order, the voxels
/// of one block by one thread.
template <typename Body>
void for_each_voxel(const BlockLayout& layout, const Body& body) {
  parallel_for_each_index(layout.block_count(), [&](std::size_t slot) {
    const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) body(id);
  });
}

}  // namespace ridgeway::detail
