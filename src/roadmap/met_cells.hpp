// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cell_neighbours.hpp"

namespace ridgeway::detail {

/// What a search knows of the cells that it has met, few of many: those of a block together, as who
/// asks for one asks for others of that block soon; blocks by a hash table.
template <typename Met>
class MetCells {
 public:
  struct Block {
    std::uint32_t number = 0;  ///< cells divided by CellGraph::kPerBlock
    float bound = -1.0f;       ///< that a search has of all cells of the block; below 0: not yet
    std::array<Met, CellGraph::kPerBlock> cells{};
  };

  /// Place of a block, for block(); one that was not met is from now on.
  std::uint32_t meet(std::uint32_t number) {
    std::uint32_t& place = table_[place_in_table(number)];
    if (place != kNone) return place;
    place = static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back().number = number;
    if (2 * blocks_.size() <= table_.size()) return place;
    grow();
    return static_cast<std::uint32_t>(blocks_.size()) - 1;
  }
  /// Valid until meet() is called for another one.
  Block& block(std::uint32_t place) { return blocks_[place]; }

  Met& operator[](CellId cell) {
    return blocks_[meet(cell / CellGraph::kPerBlock)].cells[cell % CellGraph::kPerBlock];
  }
  /// Null for a cell of a block that was not met.
  const Met* find(CellId cell) const {
    const std::uint32_t place = table_[place_in_table(cell / CellGraph::kPerBlock)];
    return place == kNone ? nullptr : &blocks_[place].cells[cell % CellGraph::kPerBlock];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Where a block is, or has to be put.
  std::size_t place_in_table(std::uint32_t number) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t i = number * 2654435761u & mask;  // Knuth's multiplicative hash
    while (table_[i] != kNone && blocks_[table_[i]].number != number) i = (i + 1) & mask;
    return i;
  }

  void grow() {
    table_.assign(4 * table_.size(), kNone);
    for (std::uint32_t k = 0; k < blocks_.size(); ++k)
      table_[place_in_table(blocks_[k].number)] = k;
  }

  std::vector<std::uint32_t> table_ = std::vector<std::uint32_t>(512, kNone);
  std::vector<Block> blocks_;
};

}  // namespace ridgeway::detail
