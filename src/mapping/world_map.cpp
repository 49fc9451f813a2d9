// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>
#include <vector>

#include "memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "thin_surfaces.hpp"

namespace ridgeway {
namespace {

/// Blocks of a map's own voxels from (0, 0, 0) up to one.
std::vector<BlockIndex> blocks_up_to(const VoxelIndex& end) {
  const BlockIndex first, last = block_of(end);
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
  require_within_reach(range, "bounds");
  OccupancyMap map;
  map.voxel_size = voxel_size;
  map.origin = range.min;
  map.layout = BlockLayout(blocks_up_to(range.max - range.min));
  map.state = VoxelField<VoxelState>(map.layout);
  VoxelField<float> distance(map.layout);  // metres
  const World all = world_at_all_times(world);
  World meshes;  // alone: walls without an inside are in the way, too
  meshes.meshes = world.meshes;
  const double half_diagonal = 0.5 * std::sqrt(3.0) * voxel_size;
  parallel_for_each_index(map.layout.block_count(), [&](std::size_t slot) {
    const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
      const VoxelIndex voxel = map.origin + map.layout.index_of(id);
      if (!range.contains(voxel)) continue;
      const Point centre = centre_of(voxel, voxel_size);
      distance[id] = static_cast<float>(surface_distance(all, centre).distance);
      const bool is_free =
          distance[id] > 0.0f && surface_distance(meshes, centre).distance > half_diagonal;
      map.state[id] = is_free ? VoxelState::kFree : VoxelState::kOccupied;
    }
  });
  detail::occupy_thin_surfaces(distance, map);
  return map;
}

}  // namespace ridgeway
