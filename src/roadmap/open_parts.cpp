// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "open_parts.hpp"

#include <algorithm>
#include <array>

#include "ridgeway/common/parallel.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {
namespace {

/// Whether the robot fits on every voxel of a block.
bool is_all_open(const EsdfMap& esdf, std::uint32_t slot, SquaredHalves least) {
  const std::uint32_t* squared = esdf.squared.block(slot);
  const auto is_wide = [&](std::uint32_t own) { return SquaredHalves(own) >= least; };
  if (!std::all_of(squared, squared + kBlockVoxels, is_wide)) return false;
  const VoxelState* state = esdf.state.block(slot);
  const auto is_open = [&](VoxelState s) { return ridgeway::is_open(s, esdf.unknown); };
  if (!std::all_of(state, state + kBlockVoxels, is_open)) return false;
  const FlightLimits& limits = esdf.limits;
  const VoxelId first = slot * kBlockVoxels;
  for (VoxelId id = first; limits.any() && id < first + kBlockVoxels; ++id)
    if (!limits.allow_voxel(esdf.layout.index_of(id), esdf.voxel_size)) return false;
  return true;
}

}  // namespace

std::vector<std::uint32_t> find_open_parts(const EsdfMap& esdf, double radius) {
  constexpr std::array kFacesAhead{14, 16, 22};
  const BlockLayout& layout = esdf.layout;
  const SquaredHalves least = least_clearance(radius, esdf.voxel_size);
  std::vector<std::uint32_t> parts(layout.block_count(), CellGraph::kNotOpen);
  parallel_for_each_index(
      parts.size(),
      [&](std::size_t rank) {
        const auto number = static_cast<std::uint32_t>(rank);
        if (is_all_open(esdf, layout.slot_at(number), least)) parts[rank] = number;
      },
      64);
  // Moves across a face are as wide as their ends, so neighbours that are all open are connected.
  DisjointSets joined(parts.size());
  for (std::uint32_t rank = 0; rank < parts.size(); ++rank)
    for (const int direction : kFacesAhead) {
      const std::uint32_t beside = layout.neighbour_block(layout.slot_at(rank), direction);
      if (parts[rank] == CellGraph::kNotOpen || beside == BlockLayout::kNoBlock) continue;
      if (parts[layout.rank(beside)] != CellGraph::kNotOpen) joined.join(rank, layout.rank(beside));
    }
  for (std::uint32_t rank = 0; rank < parts.size(); ++rank)
    if (parts[rank] != CellGraph::kNotOpen) parts[rank] = joined.find(rank);
  return parts;
}

std::uint32_t open_part_of(const Roadmap& roadmap, VoxelId from) {
  const BlockLayout& layout = roadmap.esdf.layout;
  const std::vector<std::uint32_t>& parts = roadmap.cells.open_parts;
  for (VoxelId at = from; !parts.empty() && at != kNoVoxel;) {
    const std::uint32_t part = parts[layout.rank(at / kBlockVoxels)];
    if (part != CellGraph::kNotOpen) return part;
    const Direction next = roadmap.attach.next[at];
    if (next == AttachField::kHere || next == AttachField::kNotTraversable) break;
    at = layout.neighbour(at, next);
  }
  return CellGraph::kNotOpen;
}

}  // namespace ridgeway::detail
