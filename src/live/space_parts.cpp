// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "space_parts.hpp"

#include <algorithm>

#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {
namespace {

/// Takes apart what a change touches, and puts it together again.
class PartsUpdate {
 public:
  PartsUpdate(SpaceParts& parts, const BlockLayout& layout, const std::vector<BlockWays>& blocks,
              const BasinNumbers& numbers, const BasinJoins& joins)
      : parts_(parts),
        layout_(layout),
        blocks_(blocks),
        numbers_(numbers),
        joins_(joins),
        is_listed_(layout.block_count()) {}

  void run(std::span<const std::uint32_t> changed, std::span<const std::uint32_t> left) {
    for (const std::uint32_t basin : left) release(basin);
    for (const std::uint32_t slot : changed) {
      list(slot);
      if (blocks_[slot].top == 0) continue;
      for_each_basin(numbers_, slot, [&](std::uint32_t basin) { release(basin); });
      for (const auto& [a, b] : joins_[slot]) {
        release(a);
        release(b);
      }
    }
    put_together(basins_without_part());
  }

 private:
  void list(std::uint32_t slot) {
    if (blocks_[slot].top > 0 && std::exchange(is_listed_[slot], std::uint8_t{1}) == 0)
      slots_.push_back(slot);
  }

  void release(std::uint32_t basin) {
    if (!parts_.has(basin)) return;
    const std::uint32_t part = parts_.of_basin[basin];
    for (const std::uint32_t slot : parts_.parts[part].slots) list(slot);
    parts_.parts[part] = {};
    parts_.unused.push_back(part);
  }

  /// Those that meet in the listed blocks, each once; from now on they have none by their number
  /// either.
  std::vector<std::uint32_t> basins_without_part() {
    std::vector<std::uint32_t> basins;
    for (const std::uint32_t slot : slots_)
      for_each_basin(numbers_, slot, [&](std::uint32_t basin) {
        if (!parts_.has(basin)) basins.push_back(basin);
      });
    std::sort(basins.begin(), basins.end());
    basins.erase(std::unique(basins.begin(), basins.end()), basins.end());
    if (!basins.empty() && basins.back() >= parts_.of_basin.size())
      parts_.of_basin.resize(basins.back() + 1, SpaceParts::kNoPart);
    for (const std::uint32_t basin : basins) parts_.of_basin[basin] = SpaceParts::kNoPart;
    return basins;
  }

  void put_together(const std::vector<std::uint32_t>& basins) {
    DisjointSets sets(parts_.of_basin.size());
    for (const std::uint32_t slot : slots_)
      for (const auto& [a, b] : joins_[slot])
        if (!parts_.has(a)) sets.join(a, b);
    std::vector<std::uint32_t> part_of_set(parts_.of_basin.size(), SpaceParts::kNoPart);
    for (const std::uint32_t basin : basins)
      if (std::uint32_t& part = part_of_set[sets.find(basin)]; part == SpaceParts::kNoPart)
        part = new_part();
    for (const std::uint32_t slot : slots_)
      for_each_basin(numbers_, slot, [&](std::uint32_t basin) {
        const std::uint32_t part = part_of_set[sets.find(basin)];
        if (part != SpaceParts::kNoPart)
          parts_.parts[part].add(slot, layout_.block(slot), blocks_[slot].top);
      });
    for (const std::uint32_t basin : basins) parts_.of_basin[basin] = part_of_set[sets.find(basin)];
  }

  std::uint32_t new_part() {
    if (parts_.unused.empty()) {
      parts_.unused.push_back(static_cast<std::uint32_t>(parts_.parts.size()));
      parts_.parts.emplace_back();
    }
    const std::uint32_t part = parts_.unused.back();
    parts_.unused.pop_back();
    return part;
  }

  SpaceParts& parts_;
  const BlockLayout& layout_;
  const std::vector<BlockWays>& blocks_;
  const BasinNumbers& numbers_;
  const BasinJoins& joins_;
  std::vector<std::uint8_t> is_listed_;  // by block
  std::vector<std::uint32_t> slots_;     // of what was taken apart, and of what changed
};

}  // namespace

void SpacePart::add(std::uint32_t slot, const BlockIndex& block, std::uint32_t level) {
  if (top == 0) low = high = block;
  if (slots.empty() || slots.back() != slot) slots.push_back(slot);
  low = {std::min(low.x, block.x), std::min(low.y, block.y), std::min(low.z, block.z)};
  high = {std::max(high.x, block.x), std::max(high.y, block.y), std::max(high.z, block.z)};
  top = std::max(top, level);
}

void update_parts(SpaceParts& parts, const BlockLayout& layout,
                  const std::vector<BlockWays>& blocks, const BasinNumbers& numbers,
                  const BasinJoins& joins, std::span<const std::uint32_t> changed,
                  std::span<const std::uint32_t> left) {
  PartsUpdate(parts, layout, blocks, numbers, joins).run(changed, left);
}

}  // namespace ridgeway::detail
