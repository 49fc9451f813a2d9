// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "work_domain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mapping/memory_limit.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "site_limit.hpp"

namespace ridgeway::detail {
namespace {

/// The first and the last of some ascending numbers that are within a radius of one, if any.
std::optional<std::pair<int, int>> range_near(const std::vector<int>& numbers, int middle,
                                              int radius) {
  const auto first = std::lower_bound(numbers.begin(), numbers.end(), middle - radius);
  const auto end = std::upper_bound(first, numbers.end(), middle + radius);
  if (first == end) return std::nullopt;
  return std::pair(*first, *(end - 1));
}

/// Of the blocks that hold an obstacle, the x of each row (y, z), ascending, by y, by z.
using ObstacleRows = std::map<int, std::map<int, std::vector<int>>>;

ObstacleRows rows_of(const BlockLayout& layout, const std::vector<bool>& occupied) {
  ObstacleRows rows;
  for (std::uint32_t rank = 0; rank < layout.block_count(); ++rank)
    if (const std::uint32_t slot = layout.slot_at(rank); occupied[slot]) {
      const BlockIndex& block = layout.block(slot);
      rows[block.z][block.y].push_back(block.x);
    }
  return rows;
}

/// Whether a block lies within a Chebyshev distance of one of the rows.
bool is_within(const ObstacleRows& rows, const BlockIndex& block, int radius) {
  const auto last_plane = rows.upper_bound(block.z + radius);
  for (auto plane = rows.lower_bound(block.z - radius); plane != last_plane; ++plane) {
    const auto last_row = plane->second.upper_bound(block.y + radius);
    for (auto row = plane->second.lower_bound(block.y - radius); row != last_row; ++row)
      if (range_near(row->second, block.x, radius)) return true;
  }
  return false;
}

/// That distance, or `most` where it is larger.
int nearest_in(const ObstacleRows& rows, const BlockIndex& block, int most) {
  int beyond = 0, within = 1;  // beyond the one, within the other
  while (within < most && !is_within(rows, block, within)) {
    beyond = within;
    within = std::min(2 * within, most);
  }
  while (within - beyond > 1) {
    const int middle = beyond + (within - beyond) / 2;
    (is_within(rows, block, middle) ? within : beyond) = middle;
  }
  return within;
}

/// Upper bound of the Chebyshev distance, in blocks, from each block to an occupied one, or
/// `most`, if that is less: steps through the layout, or a search where no step leads there.
std::vector<int> blocks_to_obstacle(const BlockLayout& layout, const std::vector<bool>& occupied,
                                    const ObstacleRows& rows, int most) {
  std::vector<int> steps(layout.block_count(), -1);
  std::vector<std::uint32_t> front;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    if (occupied[slot]) {
      steps[slot] = 0;
      front.push_back(slot);
    }
  while (!front.empty()) {
    stop_if_cancelled();
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
  parallel_for_each_index(steps.size(), [&](std::size_t slot) {
    if (steps[slot] < 0)
      steps[slot] = nearest_in(rows, layout.block(static_cast<std::uint32_t>(slot)), most);
  });
  return steps;
}

/// Blocks that are collected up to what memory allows.
class BlockSet {
 public:
  explicit BlockSet(int bytes_per_voxel)
      : most_(std::min<std::uint64_t>(
            BlockLayout::kMostBlocks,
            available_memory_bytes() / (static_cast<std::uint64_t>(kBlockVoxels) *
                                        static_cast<std::uint64_t>(bytes_per_voxel)))) {}

  /// Adds the blocks along an axis in line with a block, from `first` to `last`.
  void add_run(BlockIndex block, int BlockIndex::*axis, int first, int last) {
    for (block.*axis = first; block.*axis <= last; ++(block.*axis)) {
      blocks_.insert(block);
      if (blocks_.size() > most_)
        throw InputError(
            "map", "with unknown space ignored needs more memory than is available",
            "give a max_distance, take unknown space as an obstacle, or use larger voxels");
    }
  }

  std::vector<BlockIndex> list() const { return {blocks_.begin(), blocks_.end()}; }

 private:
  const std::uint64_t most_;
  std::unordered_set<BlockIndex, BlockHash> blocks_;
};

/// How far from a block, in blocks along each axis, obstacles count for target blocks that the
/// sweeps reach from there.
using Reach = std::unordered_map<BlockIndex, int, BlockHash>;

void raise(Reach& reach, const BlockIndex& block, int radius) {
  int& known = reach.try_emplace(block, radius).first->second;
  known = std::max(known, radius);
}

/// The sweep along z: from the planes with obstacles in reach. Returns where it begins in them.
Reach run_along_z(const Reach& targets, const ObstacleRows& rows, BlockSet& domain) {
  Reach begins;
  for (const auto& [block, radius] : targets) {
    stop_if_cancelled();
    int first = block.z, last = block.z;
    const auto end = rows.upper_bound(block.z + radius);
    for (auto plane = rows.lower_bound(block.z - radius); plane != end; ++plane) {
      raise(begins, {block.x, block.y, plane->first}, radius);
      first = std::min(first, plane->first);
      last = std::max(last, plane->first);
    }
    domain.add_run(block, &BlockIndex::z, first, last);
  }
  return begins;
}

/// Before that the sweep along y, within planes, from the rows with obstacles in reach.
Reach run_along_y(const Reach& ends, const ObstacleRows& rows, BlockSet& domain) {
  Reach begins;
  for (const auto& [block, radius] : ends) {
    stop_if_cancelled();
    int first = block.y, last = block.y;
    const std::map<int, std::vector<int>>& plane = rows.at(block.z);
    const auto end = plane.upper_bound(block.y + radius);
    for (auto row = plane.lower_bound(block.y - radius); row != end; ++row) {
      if (!range_near(row->second, block.x, radius)) continue;
      raise(begins, {block.x, row->first, block.z}, radius);
      first = std::min(first, row->first);
      last = std::max(last, row->first);
    }
    domain.add_run(block, &BlockIndex::y, first, last);
  }
  return begins;
}

/// And before that the sweep along x, within rows, from their obstacles in reach.
void run_along_x(const Reach& ends, const ObstacleRows& rows, BlockSet& domain) {
  for (const auto& [block, radius] : ends) {
    stop_if_cancelled();
    if (const auto range = range_near(rows.at(block.z).at(block.y), block.x, radius))
      domain.add_run(block, &BlockIndex::x, std::min(block.x, range->first),
                     std::max(block.x, range->second));
  }
}

}  // namespace

BlockLayout with_neighbour_blocks(const BlockLayout& layout, bool planar) {
  std::vector<BlockIndex> around;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex o = offset_of(d);
      if (planar && o.z != 0) continue;
      if (layout.neighbour_block(slot, d) == BlockLayout::kNoBlock)
        around.push_back(layout.block(slot) + BlockIndex{o.x, o.y, o.z});
    }
  if (layout.is_in_order()) {  // and so it stays
    around.insert(around.end(), layout.blocks().begin(), layout.blocks().end());
    return BlockLayout(std::move(around));
  }
  BlockLayout grown = layout;
  grown.add(around);
  return grown;
}

BlockLayout sweep_domain(const BlockLayout& target, const std::vector<bool>& occupied,
                         double farthest, int bytes_per_voxel) {
  const ObstacleRows rows = rows_of(target, occupied);
  if (rows.empty()) return target;
  const double most = site_limit(farthest);
  const std::vector<int> steps =
      blocks_to_obstacle(target, occupied, rows, static_cast<int>(std::ceil(most / kBlockSide)));
  Reach targets;
  for (std::uint32_t slot = 0; slot < target.block_count(); ++slot) {
    // A block k steps away lies within (k + 1) block diagonals of an obstacle voxel.
    const double bound = std::min(std::sqrt(3.0) * kBlockSide * (steps[slot] + 1), most);
    targets[target.block(slot)] = static_cast<int>(std::ceil(bound / kBlockSide));
  }
  BlockSet domain(bytes_per_voxel);
  const Reach in_planes = run_along_z(targets, rows, domain);
  run_along_x(run_along_y(in_planes, rows, domain), rows, domain);
  return BlockLayout(domain.list());
}

}  // namespace ridgeway::detail
