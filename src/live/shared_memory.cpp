// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "shared_memory.hpp"

#include <algorithm>

#include "ridgeway/common/parallel.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {

EsdfMap in_same_memory(const EsdfMap& esdf) {
  EsdfMap same{.voxel_size = esdf.voxel_size,
               .origin = esdf.origin,
               .unknown = esdf.unknown,
               .max_distance = esdf.max_distance,
               .limits = esdf.limits,
               .planar = esdf.planar,
               .layout = {},
               .state = {},
               .squared = {},
               .site = {},
               .obstacle = esdf.obstacle};
  parallel_for_each_index(2, [&](std::size_t task) {  // each as many bytes
    if (task == 0) {
      same.layout = esdf.layout;
    } else {
      same.state = esdf.state.shared();
      same.squared = esdf.squared.shared();
      same.site = esdf.site.shared();
    }
  });
  return same;
}

Roadmap in_same_memory(const Roadmap& roadmap) {
  Roadmap same;
  same.esdf = in_same_memory(roadmap.esdf);
  same.source = roadmap.source;
  same.config = roadmap.config;
  same.min_clearance = roadmap.min_clearance;
  same.diagram = roadmap.diagram;
  same.graph = roadmap.graph;
  same.attach = {roadmap.attach.next.shared()};
  same.tree = roadmap.tree;
  same.landmarks = roadmap.landmarks;
  return same;
}

VoxelField<Direction> ways_to_build_on(LiveAttach& attach, const BlockLayout& layout,
                                       const VoxelField<Direction>& next,
                                       const VoxelMask& traversable, const TouchedSpace& space) {
  attach.next.grow(layout, AttachField::kNotTraversable);
  VoxelField<Direction> ways = attach.next.shared();
  parallel_for_each_index(
      space.slots.size(),
      [&](std::size_t i) {
        const std::uint32_t slot = space.slots[i];
        ways.own_block(slot);
        std::copy_n(next.block(slot), kBlockVoxels, ways.block(slot));
        if (!space.has_rest) return;
        for_each_in(Rest{&traversable, &space.touched}.block(slot), slot,
                    [&](VoxelId id) { ways[id] = attach.next[id]; });
      },
      64);
  return ways;
}

AttachField share(LiveAttach& attach, const TouchedSpace& space, AttachField now) {
  parallel_for_each_index(
      space.slots.size(),
      [&](std::size_t i) {
        const std::uint32_t slot = space.slots[i];
        const Direction* fresh = now.next.block(slot);
        if (std::equal(fresh, fresh + kBlockVoxels, attach.next.block(slot)))
          now.next.share_block(attach.next, slot);
        else
          attach.next.share_block(now.next, slot);
      },
      64);
  return now;
}

}  // namespace ridgeway::detail
