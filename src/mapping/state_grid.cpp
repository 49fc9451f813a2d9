// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "state_grid.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// A block of a grid: the lowest place, axis by axis, of its known voxels; 8 where none is known.
struct LowestKnown {
  std::uint8_t x = kBlockSide, y = kBlockSide, z = kBlockSide;
  bool any() const { return x < kBlockSide; }
};

/// The blocks that cover a grid from its voxel `first` on.
class GridBlocks {
 public:
  GridBlocks(const StateGrid& grid, const VoxelIndex& first)
      : grid_(&grid),
        first_(first),
        count_{blocks_for(grid.shape[0] - first.x), blocks_for(grid.shape[1] - first.y),
               blocks_for(grid.shape[2] - first.z)} {}

  std::size_t size() const { return count_[0] * count_[1] * count_[2]; }

  BlockIndex index(std::size_t i) const {
    return {static_cast<int>(i % count_[0]), static_cast<int>(i / count_[0] % count_[1]),
            static_cast<int>(i / count_[0] / count_[1])};
  }

  /// What lies beyond the grid stays as it is.
  void read(const BlockIndex& block, VoxelState* states) const {
    const VoxelIndex first = first_ + voxel_of(block, 0);
    grid_->read(first,
                {std::min(kBlockSide, grid_->shape[0] - first.x),
                 std::min(kBlockSide, grid_->shape[1] - first.y),
                 std::min(kBlockSide, grid_->shape[2] - first.z)},
                states);
  }

  std::vector<LowestKnown> find_known() const {
    std::vector<LowestKnown> known(size());
    parallel_for_each_index(
        size(),
        [&](std::size_t i) {
          std::array<VoxelState, kBlockVoxels> states{};
          read(index(i), states.data());
          LowestKnown& low = known[i];
          for (int local = 0; local < kBlockVoxels; ++local) {
            if (states[static_cast<std::size_t>(local)] == VoxelState::kUnknown) continue;
            low.x = std::min(low.x, static_cast<std::uint8_t>(local & 7));
            low.y = std::min(low.y, static_cast<std::uint8_t>(local >> 3 & 7));
            low.z = std::min(low.z, static_cast<std::uint8_t>(local >> 6));
          }
        },
        16);
    return known;
  }

 private:
  static std::size_t blocks_for(int voxels) {
    return (static_cast<std::size_t>(voxels) + kBlockSide - 1) / kBlockSide;
  }

  const StateGrid* grid_;
  VoxelIndex first_;
  std::array<std::size_t, 3> count_;
};

/// The lowest known voxel along each axis, counted from the grid's first; that first one where none
/// is known.
VoxelIndex lowest_known(const GridBlocks& blocks, const std::vector<LowestKnown>& known) {
  VoxelIndex low = {kMaxVoxelIndex, kMaxVoxelIndex, kMaxVoxelIndex};
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!known[i].any()) continue;
    const VoxelIndex corner = voxel_of(blocks.index(i), 0);
    low.x = std::min(low.x, corner.x + known[i].x);
    low.y = std::min(low.y, corner.y + known[i].y);
    low.z = std::min(low.z, corner.z + known[i].z);
  }
  return low.x == kMaxVoxelIndex ? VoxelIndex{} : low;
}

}  // namespace

OccupancyMap map_from_grid(const StateGrid& grid, double voxel_size, const std::string& name) {
  validate_voxel_size(voxel_size, "voxel_size");
  const VoxelRange whole = {{0, 0, 0}, {grid.shape[0] - 1, grid.shape[1] - 1, grid.shape[2] - 1}};
  OccupancyMap map;
  map.voxel_size = voxel_size;
  map.origin = grid.low;
  if (whole.empty()) return map;
  require_within_reach(moved(whole, grid.low), name);

  GridBlocks blocks(grid, {});
  std::vector<LowestKnown> known = blocks.find_known();
  const VoxelIndex low = lowest_known(blocks, known);
  if (low != VoxelIndex{}) {
    blocks = GridBlocks(grid, low);
    known = blocks.find_known();
  }
  std::vector<BlockIndex> indices;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i].any()) indices.push_back(blocks.index(i));
  require_memory_for_blocks(static_cast<double>(indices.size()), kPipelineBytesPerVoxel, name);
  map.origin = grid.low + low;
  map.layout = BlockLayout(std::move(indices));
  map.state = VoxelField<VoxelState>(map.layout);
  parallel_for_each_index(
      map.layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        blocks.read(map.layout.block(slot), map.state.block(slot));
      },
      16);
  return map;
}

}  // namespace ridgeway
