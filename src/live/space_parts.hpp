// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ridgeway/skeleton/basins.hpp"
#include "skeleton/watershed.hpp"

namespace ridgeway::detail {

/// A 26-connected part of traversable space: the blocks that it reaches into, the box around
/// these, and its highest level; zero for a number that no part has.
struct SpacePart {
  std::vector<std::uint32_t> slots = {};  ///< each once
  BlockIndex low{}, high{};
  std::uint32_t top = 0;

  void add(std::uint32_t slot, const BlockIndex& block, std::uint32_t level);
};

/// By block, the pairs of basins that passes in it join; they hang together.
using BasinJoins = std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>>;

/// The parts of a space that changes. Invariant: each voxel's part is that of its basin's number.
struct SpaceParts {
  static constexpr std::uint32_t kNoPart = 0xffffffffu;
  std::vector<SpacePart> parts = {};
  std::vector<std::uint32_t> of_basin = {};  ///< by number of a basin; stale where none has it
  std::vector<std::uint32_t> unused = {};    ///< numbers of parts

  bool has(std::uint32_t basin) const {
    return basin < of_basin.size() && of_basin[basin] != kNoPart && parts[of_basin[basin]].top > 0;
  }
};

/// Calls body(basin) for the basins that meet in a block with traversable voxels.
template <typename Body>
void for_each_basin(const BasinNumbers& numbers, std::uint32_t slot, const Body& body) {
  if (numbers.whole[slot] != BasinNumbers::kSeveral) return body(numbers.whole[slot]);
  for (const std::uint32_t basin : numbers.several[slot].basins) body(basin);
}

/// Follows basins after a change; in time that follows the parts that it touches. `changed`: the
/// blocks, each once, in which a number, a level or a join may be another. `left`: basins that met
/// in one of them before.
void update_parts(SpaceParts& parts, const BlockLayout& layout,
                  const std::vector<BlockWays>& blocks, const BasinNumbers& numbers,
                  const BasinJoins& joins, std::span<const std::uint32_t> changed,
                  std::span<const std::uint32_t> left);

}  // namespace ridgeway::detail
