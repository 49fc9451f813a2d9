// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/map_edits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/number_text.hpp"
#include "memory_limit.hpp"
#include "planar.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {
namespace {

/// All voxels of a block.
VoxelRange voxels_of(const BlockIndex& block) {
  return {voxel_of(block, 0), voxel_of(block, kBlockVoxels - 1)};
}

/// Calls visit(slot, range) for every allocated block, in parallel.
template <typename Visit>
void for_each_block(const BlockLayout& layout, const Visit& visit) {
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        visit(slot, voxels_of(layout.block(slot)));
      },
      64);
}

/// The same states on the map's blocks and more.
OccupancyMap with_blocks(OccupancyMap map, std::vector<BlockIndex> more) {
  if (more.empty()) return map;
  more.insert(more.end(), map.layout.blocks().begin(), map.layout.blocks().end());
  OccupancyMap result;
  result.voxel_size = map.voxel_size;
  result.origin = map.origin;
  result.planar = map.planar;
  result.layout = BlockLayout(std::move(more));
  result.state = VoxelField<VoxelState>(result.layout);
  for_each_block(map.layout, [&](std::uint32_t slot, const VoxelRange&) {
    const VoxelState* from = map.state.block(slot);
    const std::uint32_t target = result.layout.find_block(map.layout.block(slot));
    std::copy(from, from + kBlockVoxels, result.state.block(target));
  });
  return result;
}

/// A box as a map has it: in a plane heights play no part.
Box box_in(const OccupancyMap& map, Box box) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (map.planar) {
    box.min.z() = -kInfinity;
    box.max.z() = kInfinity;
  }
  return box;
}

/// A range of the lattice's voxels as the map's own.
VoxelRange own_voxels(const OccupancyMap& map, const VoxelRange& lattice) {
  return moved(lattice, VoxelIndex{} - map.origin);
}

/// Gives every 26-connected cluster of fewer than `enough` voxels of a state another state.
void change_small_clusters(OccupancyMap& map, VoxelState state, double enough, VoxelState to) {
  if (enough <= 1.0) return;
  VoxelMask seen(map.layout);
  std::vector<VoxelId> cluster;
  const auto visit = [&](VoxelId id) {
    if (map.state[id] != state || seen.test(id)) return;
    seen.set(id);
    cluster.push_back(id);
  };
  for (VoxelId seed = 0; seed < map.state.size(); ++seed) {
    cluster.clear();
    visit(seed);
    for (std::size_t next = 0; next < cluster.size(); ++next)
      for (int direction = 0; direction < 27; ++direction)
        if (const VoxelId id = map.layout.neighbour(cluster[next], direction); id != kNoVoxel)
          visit(id);
    if (static_cast<double>(cluster.size()) < enough)
      for (const VoxelId id : cluster) map.state[id] = to;
  }
}

}  // namespace

OccupancyMap crop(OccupancyMap map, const Box& bounds, double beyond) {
  validate_box(bounds, "bounds");
  const Box box = box_in(map, bounds);
  const VoxelRange inside = own_voxels(map, voxels_inside(box, map.voxel_size));
  const Box with_upper_faces = {box.min, box.max + Point::Constant(beyond)};
  const VoxelRange touched = own_voxels(map, voxels_overlapping(with_upper_faces, map.voxel_size));
  for_each_block(map.layout, [&](std::uint32_t slot, const VoxelRange& block) {
    if (inside.contains(block.min) && inside.contains(block.max)) return;
    VoxelState* states = map.state.block(slot);
    for (int local = 0; local < kBlockVoxels; ++local) {
      const VoxelIndex voxel = voxel_of(map.layout.block(slot), local);
      const VoxelRange& kept = states[local] == VoxelState::kOccupied ? touched : inside;
      if (!kept.contains(voxel)) states[local] = VoxelState::kUnknown;
    }
  });
  return normalised(std::move(map));
}

OccupancyMap add_no_fly(OccupancyMap map, std::span<const Box> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    validate_box(boxes[i], "no-fly box " + std::to_string(i + 1));
  if (boxes.empty()) return map;

  // Whole blocks: where unknown space is free, it is so to the ends of the blocks.
  const VoxelRange known = known_range(map);
  VoxelRange near = grown(known, kBlockSide);
  if (map.planar) std::tie(near.min.z, near.max.z) = std::tie(known.min.z, known.max.z);
  const VoxelRange reach = {voxel_of(block_of(near.min), 0),
                            voxel_of(block_of(near.max), kBlockVoxels - 1)};
  std::vector<VoxelRange> closed;
  std::vector<BlockIndex> missing;
  double block_count = map.layout.block_count();
  for (const Box& box : boxes) {
    const VoxelRange range =
        intersection(own_voxels(map, voxels_overlapping(box_in(map, box), map.voxel_size)), reach);
    if (range.empty()) continue;
    closed.push_back(range);
    block_count = std::max(block_count, range.block_count());
    require_memory_for_blocks(block_count, kPipelineBytesPerVoxel, "no-fly boxes");
    const BlockIndex first = block_of(range.min), last = block_of(range.max);
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
          if (map.layout.find_block({x, y, z}) == BlockLayout::kNoBlock)
            missing.push_back({x, y, z});
  }

  OccupancyMap result = with_blocks(std::move(map), std::move(missing));
  for_each_block(result.layout, [&](std::uint32_t slot, const VoxelRange& block) {
    for (const VoxelRange& range : closed) {
      const VoxelRange here = intersection(range, block);
      if (here.empty()) continue;
      VoxelState* states = result.state.block(slot);
      for (int z = here.min.z; z <= here.max.z; ++z)
        for (int y = here.min.y; y <= here.max.y; ++y)
          for (int x = here.min.x; x <= here.max.x; ++x)
            states[local_of({x, y, z})] = VoxelState::kOccupied;
    }
  });
  return normalised(std::move(result));
}

OccupancyMap remove_isolated(OccupancyMap map, int min_cluster) {
  if (min_cluster < 0) {
    throw InputError("isolated_below", "is " + std::to_string(min_cluster),
                     "give a number of voxels, 0 to keep all");
  }
  change_small_clusters(map, VoxelState::kOccupied,
                        static_cast<double>(min_cluster) * detail::copies_of_a_voxel(map),
                        VoxelState::kFree);
  return map;
}

OccupancyMap remove_pockets(OccupancyMap map, double min_volume) {
  if (!(min_volume >= 0.0)) {
    throw InputError("min_volume", "is " + number_text(min_volume),
                     "give cubic metres, 0 to keep all");
  }
  const double voxels = min_volume / std::pow(map.voxel_size, 3);
  change_small_clusters(map, VoxelState::kFree, voxels * detail::copies_of_a_voxel(map),
                        VoxelState::kUnknown);
  return map;
}

}  // namespace ridgeway
