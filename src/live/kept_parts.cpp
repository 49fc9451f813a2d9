// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "kept_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ridgeway::detail {
namespace {

/// The numbers that vertices get in the merged graph, by those that they had; kNoVertex for one
/// that is not taken.
using NewNumbers = std::vector<VertexId>;

/// By the order of their voxels: those of the first graph that stand in a set, all of the second.
std::pair<NewNumbers, NewNumbers> number_together(const BlockLayout& layout,
                                                  const SparseGraph& first, const Rest& within,
                                                  const SparseGraph& second) {
  const auto voxel_of = [&](const SparseGraph& graph, std::size_t v) {
    return layout.find(graph.vertices[v].voxel);
  };
  NewNumbers of_first(first.vertices.size(), kNoVertex), of_second(second.vertices.size());
  std::uint32_t count = 0;
  std::size_t next = 0;
  const auto take_up_to = [&](std::uint64_t order) {
    for (; next < of_second.size() && layout.order_of(voxel_of(second, next)) < order; ++next)
      of_second[next] = VertexId{count++};
  };
  for (std::size_t v = 0; v < of_first.size(); ++v) {
    const VoxelId id = voxel_of(first, v);
    if (!within.test(id)) continue;
    take_up_to(layout.order_of(id));
    of_first[v] = VertexId{count++};
  }
  take_up_to(~std::uint64_t{0});
  return {std::move(of_first), std::move(of_second)};
}

/// Graph, clearance tree and landmarks, each vertex at its new number.
void take(const Roadmap& from, const NewNumbers& numbers, Roadmap& to) {
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] == kNoVertex) continue;
    const std::size_t at = number(numbers[v]);
    to.graph.vertices[at] = from.graph.vertices[v];
    to.tree.parent[at] = numbers[number(from.tree.parent[v])];
    to.tree.clearance[at] = from.tree.clearance[v];
    to.tree.place[at] = from.tree.place[v];
    to.landmarks.lengths[at] = from.landmarks.lengths[v];
  }
  for (const Edge& edge : from.graph.edges)
    if (numbers[number(edge.from)] != kNoVertex)
      to.graph.edges.push_back(
          {numbers[number(edge.from)], numbers[number(edge.to)], edge.length, edge.clearance});
}

/// In blocks that are as before the memory of the last one is shared. Returns how many voxels more
/// it has.
std::ptrdiff_t add_kept_diagram(const VoxelMask& before, const Rest& rest,
                                std::span<const std::uint32_t> changed, Roadmap& roadmap) {
  VoxelMask all = before;
  all.grow(roadmap.esdf.layout);
  const VoxelMask& fresh = roadmap.diagram.voxels;
  std::vector<std::uint32_t> slots = slots_of_any({rest.without, &fresh});
  slots.insert(slots.end(), changed.begin(), changed.end());
  std::ptrdiff_t more = 0;
  for (const std::uint32_t slot : slots) {
    VoxelMask::Block block = slot < before.block_count()
                                 ? both(before.block(slot), rest.block(slot))
                                 : VoxelMask::Block{};
    for (std::size_t z = 0; z < kBlockSide; ++z) block[z] |= fresh.block(slot)[z];
    const VoxelMask::Block& last = std::as_const(all).block(slot);
    if (block == last) continue;
    more +=
        static_cast<std::ptrdiff_t>(count_of(block)) - static_cast<std::ptrdiff_t>(count_of(last));
    all.block(slot) = block;
  }
  roadmap.diagram.voxels = std::move(all);
  return more;
}

}  // namespace

std::ptrdiff_t add_kept_parts(const Roadmap& before, const Rest& rest,
                              std::span<const std::uint32_t> changed, Roadmap& roadmap) {
  const std::ptrdiff_t more = add_kept_diagram(before.diagram.voxels, rest, changed, roadmap);
  const auto [of_before, of_now] =
      number_together(roadmap.esdf.layout, before.graph, rest, roadmap.graph);
  const auto kept_vertices =
      std::count_if(of_before.begin(), of_before.end(), [](VertexId v) { return v != kNoVertex; });
  const std::size_t count = of_now.size() + static_cast<std::size_t>(kept_vertices);
  Roadmap merged;
  merged.graph.min_clearance = roadmap.graph.min_clearance;
  merged.graph.vertices.resize(count);
  merged.graph.edges.reserve(before.graph.edges.size() + roadmap.graph.edges.size());
  merged.tree.parent.resize(count);
  merged.tree.clearance.resize(count);
  merged.tree.place.resize(count);
  merged.landmarks.lengths.resize(count);
  take(before, of_before, merged);
  take(roadmap, of_now, merged);
  index_links(merged.graph);
  merged.graph.edges.shrink_to_fit();
  roadmap.graph = std::move(merged.graph);
  roadmap.tree = std::move(merged.tree);
  roadmap.landmarks = std::move(merged.landmarks);
  return more;
}

}  // namespace ridgeway::detail
