// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/occupancy_builder.hpp"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "memory_limit.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {

void validate_voxel_size(double voxel_size, const std::string& name) {
  if (voxel_size >= 1e-6 && voxel_size <= 1e6) return;
  std::ostringstream what;
  what << "is " << voxel_size << " m";
  throw InputError(name, what.str(), "give a length from 1e-6 to 1e6 metres, for example 0.1");
}

OccupancyBuilder::OccupancyBuilder(double voxel_size, Config config)
    : voxel_size_(voxel_size), config_(std::move(config)) {
  validate_voxel_size(voxel_size, "voxel_size");
  config_.clip = intersection(config_.clip, kAllVoxels);
  block_limit_ = static_cast<std::size_t>(available_memory_bytes() /
                                          (static_cast<std::uint64_t>(kBlockVoxels) *
                                           static_cast<std::uint64_t>(config_.bytes_per_voxel)));
}

OccupancyBuilder::Block& OccupancyBuilder::find_or_add(const BlockIndex& index) {
  const auto [place, is_new] = table_.try_emplace(index, nullptr);
  if (is_new) {
    // Until finish() a block takes a fraction of what is reckoned for it, so this is in time.
    if (blocks_.size() >= block_limit_) {
      require_memory_for_blocks(static_cast<double>(table_.size()), config_.bytes_per_voxel,
                                config_.name);
    }
    place->second = &blocks_.emplace_back();
  }
  return *place->second;
}

void OccupancyBuilder::refuse(VoxelState state) const {
  throw InputError(config_.name,
                   "gets a voxel whose state is " + std::to_string(static_cast<int>(state)),
                   "give VoxelState::kUnknown (0), kFree (1) or kOccupied (2)");
}

void OccupancyBuilder::require_reach_of(const VoxelRange& range) const {
  if (config_.clip == kAllVoxels) require_within_reach(range, config_.name);
}

void OccupancyBuilder::fill(const VoxelRange& range, VoxelState state) {
  if (state > VoxelState::kOccupied) refuse(state);
  require_reach_of(range);
  const VoxelRange clipped = intersection(range, config_.clip);
  if (clipped.empty() || state == VoxelState::kUnknown) return;
  if (clipped.block_count() > static_cast<double>(block_limit_))
    require_memory_for_blocks(clipped.block_count(), config_.bytes_per_voxel, config_.name);
  const BlockIndex first = block_of(clipped.min), last = block_of(clipped.max);
  for (int bz = first.z; bz <= last.z; ++bz)
    for (int by = first.y; by <= last.y; ++by)
      for (int bx = first.x; bx <= last.x; ++bx) {
        Block& block = block_at({bx, by, bz});
        const VoxelIndex corner = voxel_of({bx, by, bz}, 0);
        const VoxelIndex low = {std::max(clipped.min.x - corner.x, 0),
                                std::max(clipped.min.y - corner.y, 0),
                                std::max(clipped.min.z - corner.z, 0)};
        const VoxelIndex high = {std::min(clipped.max.x - corner.x, kBlockSide - 1),
                                 std::min(clipped.max.y - corner.y, kBlockSide - 1),
                                 std::min(clipped.max.z - corner.z, kBlockSide - 1)};
        for (int z = low.z; z <= high.z; ++z)
          for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
              VoxelState& current = block[static_cast<std::size_t>(local_of({x, y, z}))];
              current = std::max(current, state);
            }
      }
}

OccupancyMap OccupancyBuilder::finish() && {
  std::vector<BlockIndex> indices;
  indices.reserve(table_.size());
  for (const auto& [index, block] : table_) indices.push_back(index);
  OccupancyMap map;
  map.voxel_size = voxel_size_;
  map.layout = BlockLayout(std::move(indices));
  map.state = VoxelField<VoxelState>(map.layout);
  parallel_for_each_index(
      map.layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        const Block& block = *table_.find(map.layout.block(slot))->second;
        std::copy(block.begin(), block.end(), map.state.block(slot));
      },
      64);
  table_.clear();
  blocks_.clear();
  return normalised(std::move(map));
}

}  // namespace ridgeway
