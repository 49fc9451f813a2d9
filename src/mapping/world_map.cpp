// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/world_map.hpp"

#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/memory_limit.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/voxel_range.hpp"

namespace ridgeway {
namespace {

std::vector<BlockIndex> blocks_of(const VoxelRange& range) {
  const BlockIndex first = block_of(range.min), last = block_of(range.max);
  std::vector<BlockIndex> blocks;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) blocks.push_back({x, y, z});
  return blocks;
}

}  // namespace

OccupancyMap occupancy_of(const World& world, double voxel_size, const Box& bounds) {
  validate_voxel_size(voxel_size, "voxel_size");
  validate_world(world);
  validate_box(bounds, "bounds");
  const VoxelRange range = grown(voxels_overlapping(bounds, voxel_size), 1);
  require_memory_for_blocks(range.block_count(), kPipelineBytesPerVoxel, "the world");
  OccupancyMap map;
  map.voxel_size = voxel_size;
  map.layout = BlockLayout(blocks_of(range));
  map.state = VoxelField<VoxelState>(map.layout);
  parallel_for_each_index(map.layout.block_count(), [&](std::size_t slot) {
    const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
      const VoxelIndex voxel = map.layout.index_of(id);
      if (!range.contains(voxel)) continue;
      const bool free = surface_distance(world, centre_of(voxel, voxel_size)).distance > 0.0;
      map.state[id] = free ? VoxelState::kFree : VoxelState::kOccupied;
    }
  });
  return map;
}

}  // namespace ridgeway
