// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "thin_surfaces.hpp"

#include <bit>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

void occupy_thin_surfaces(const VoxelField<float>& distance, OccupancyMap& map) {
  const BlockLayout& layout = map.layout;
  const auto limit = static_cast<float>(kNearSurface * map.voxel_size);
  VoxelMask free(layout);
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        const VoxelState* state = map.state.block(slot);
        free.block(slot) = block_where([&](int v) { return state[v] == VoxelState::kFree; });
      },
      64);
  const VoxelMask& all_free = free;
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        const float* to_surface = distance.block(slot);
        VoxelMask::Block near = block_where([&](int v) { return to_surface[v] < limit; });
        for (std::size_t z = 0; z < kBlockSide; ++z) near[z] &= all_free.block(slot)[z];
        const VoxelMask::Block thin = thin_surfaces(near, all_free.block(slot), [&](int direction) {
          const std::uint32_t n = layout.neighbour_block(slot, direction);
          return n == BlockLayout::kNoBlock ? nullptr : &all_free.block(n);
        });
        for (std::size_t z = 0; z < kBlockSide; ++z)
          for (std::uint64_t bits = thin[z]; bits != 0; bits &= bits - 1)
            map.state.block(slot)[64 * z + static_cast<std::size_t>(std::countr_zero(bits))] =
                VoxelState::kOccupied;
      },
      16);
}

}  // namespace ridgeway::detail
