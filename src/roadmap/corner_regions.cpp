// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corner_regions.hpp"

#include <algorithm>
#include <atomic>
#include <map>

#include "attach_way.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace detail {
namespace {

constexpr Part kNewPart = 0xffff;  // not looked at yet

/// The connected part of the graph that each traversable voxel's way leads to. Every voxel is
/// walked over about once: a thread stops where it, or another, has been.
std::vector<Part> parts_of_voxels(const Roadmap& roadmap) {
  const VoxelField<Direction>& next = roadmap.attach.next;
  const BlockLayout& layout = roadmap.esdf.layout;
  const GraphComponents parts = connected_components(roadmap.graph);
  std::vector<Part> result(next.size(), kNewPart);
  const auto known = [&](VoxelId id) { return std::atomic_ref(result[id]); };
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t slot) {
        std::vector<VoxelId> way;
        const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
        for (VoxelId start = first; start < first + kBlockVoxels; ++start) {
          if (next[start] == AttachField::kNotTraversable) continue;
          way.clear();
          VoxelId id = start;
          Part part = known(id).load(std::memory_order_relaxed);
          while (part == kNewPart && next[id] != AttachField::kHere) {
            way.push_back(id);
            id = layout.neighbour(id, next[id]);
            part = known(id).load(std::memory_order_relaxed);
          }
          if (part == kNewPart) {
            way.push_back(id);
            const VertexId vertex = vertex_at(roadmap.graph, layout.index_of(id));
            const std::uint32_t label = vertex == kNoVertex ? kNoPart : parts.label[number(vertex)];
            part = static_cast<Part>(std::min<std::uint32_t>(label, kNoPart));
          }
          for (const VoxelId passed : way) known(passed).store(part, std::memory_order_relaxed);
        }
      },
      16);
  return result;
}

}  // namespace

std::vector<Part> parts_of_regions(const Roadmap& roadmap,
                                   const std::vector<std::uint32_t>& region_of_block,
                                   std::size_t regions) {
  const std::vector<Part> part_of = parts_of_voxels(roadmap);
  std::vector<Part> result(regions, kNewPart);
  for (VoxelId id = 0; id < part_of.size(); ++id) {
    if (part_of[id] == kNewPart) continue;
    Part& of_region = result[region_of_block[id / kBlockVoxels]];
    if (of_region == kNewPart) of_region = part_of[id];
    if (of_region != part_of[id]) of_region = kNoPart;
  }
  return result;
}

}  // namespace detail

BlockRegions number_regions(const BlockLayout& layout) {
  BlockRegions regions;
  std::map<BlockIndex, std::uint32_t> numbers;
  regions.region_of_block.resize(layout.block_count());
  for (std::uint32_t rank = 0; rank < layout.block_count(); ++rank) {
    const std::uint32_t slot = layout.slot_at(rank);
    const BlockIndex& block = layout.block(slot);
    const BlockIndex region{block.x >> 1, block.y >> 1, block.z >> 1};
    const auto [place, is_new] = numbers.try_emplace(region, regions.count);
    regions.count += is_new ? 1 : 0;
    regions.region_of_block[slot] = place->second;
  }
  return regions;
}

}  // namespace ridgeway
