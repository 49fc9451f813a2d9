// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "work_domain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace ridgeway::detail {
namespace {

/// Upper bound of the Chebyshev distance, in blocks, from each block to an occupied one: steps
/// through the layout, or by plain search where no step leads there.
std::vector<int> blocks_to_obstacle(const BlockLayout& layout, const std::vector<bool>& occupied) {
  std::vector<int> steps(layout.block_count(), -1);
  std::vector<std::uint32_t> front;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    if (occupied[slot]) {
      steps[slot] = 0;
      front.push_back(slot);
    }
  const std::vector<std::uint32_t> sources = front;
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t slot : front)
      for (int d = 0; d < 27; ++d) {
        const std::uint32_t n = layout.neighbour_block(slot, d);
        if (n == BlockLayout::kNoBlock || steps[n] >= 0) continue;
        steps[n] = steps[slot] + 1;
        next.push_back(n);
      }
    front = std::move(next);
  }
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    if (steps[slot] >= 0) continue;
    int nearest = kFarthestSite;
    for (const std::uint32_t source : sources) {
      const BlockIndex o = layout.block(source) - layout.block(slot);
      nearest = std::min(nearest, std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}));
    }
    steps[slot] = nearest;
  }
  return steps;
}

}  // namespace

BlockLayout with_neighbour_blocks(const BlockLayout& layout) {
  std::vector<BlockIndex> blocks(layout.blocks().begin(), layout.blocks().end());
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    for (int d = 0; d < 27; ++d)
      if (layout.neighbour_block(slot, d) == BlockLayout::kNoBlock) {
        const VoxelIndex o = offset_of(d);
        blocks.push_back(layout.block(slot) + BlockIndex{o.x, o.y, o.z});
      }
  return BlockLayout(std::move(blocks));
}

BlockLayout sweep_domain(const BlockLayout& target, const std::vector<bool>& occupied,
                         double farthest) {
  if (std::none_of(occupied.begin(), occupied.end(), [](bool any) { return any; })) return target;
  const std::vector<int> steps = blocks_to_obstacle(target, occupied);
  // A block k steps away lies within (k + 1) block diagonals of an obstacle voxel.
  std::map<BlockIndex, int> reach;
  std::vector<std::vector<BlockIndex>> by_reach;
  const auto raise = [&](const BlockIndex& block, int radius) {
    int& known = reach.try_emplace(block, -1).first->second;
    if (radius <= known) return;
    known = radius;
    if (by_reach.size() <= static_cast<std::size_t>(radius))
      by_reach.resize(static_cast<std::size_t>(radius) + 1);
    by_reach[static_cast<std::size_t>(radius)].push_back(block);
  };
  for (std::uint32_t slot = 0; slot < target.block_count(); ++slot) {
    const double bound = std::min(std::sqrt(3.0) * kBlockSide * (steps[slot] + 1), farthest);
    raise(target.block(slot), static_cast<int>(std::ceil(bound / kBlockSide)));
  }
  for (int radius = static_cast<int>(by_reach.size()) - 1; radius > 0; --radius) {
    const std::vector<BlockIndex> blocks = by_reach[static_cast<std::size_t>(radius)];
    for (const BlockIndex& block : blocks) {
      if (reach[block] != radius) continue;
      for (int d = 0; d < 27; ++d) {
        const VoxelIndex o = offset_of(d);
        raise(block + BlockIndex{o.x, o.y, o.z}, radius - 1);
      }
    }
  }
  std::vector<BlockIndex> blocks;
  blocks.reserve(reach.size());
  for (const auto& [block, radius] : reach) blocks.push_back(block);
  return BlockLayout(std::move(blocks));
}

}  // namespace ridgeway::detail
