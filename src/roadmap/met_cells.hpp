// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "cell_neighbours.hpp"

namespace ridgeway::detail {

/// A cell that a search has met.
struct MetCell {
  CellId cell = kNoCell, from = kNoCell;
  /// Of the best way to it, voxels; minus infinity once ways go on from it, as it is final then.
  float cost = std::numeric_limits<float>::infinity();
  float rest = -1.0f;  ///< of the way to the goal, about, voxels; below 0: not known yet
};

/// What a search knows of the cells that it has met: a hash table, as they are few of many.
template <typename Met = MetCell>
class MetCells {
 public:
  Met& operator[](CellId cell) {
    if (2 * count_ >= table_.size()) grow();
    return place_of(cell);
  }
  /// Null for one that was not met.
  const Met* find(CellId cell) const {
    std::size_t i = first_place(cell);
    while (table_[i].cell != cell) {
      if (table_[i].cell == kNoCell) return nullptr;
      i = (i + 1) & (table_.size() - 1);
    }
    return &table_[i];
  }

 private:
  std::size_t first_place(CellId cell) const {
    return cell * 2654435761u & (table_.size() - 1);  // Knuth's multiplicative hash
  }

  Met& place_of(CellId cell) {
    std::size_t i = first_place(cell);
    while (table_[i].cell != cell) {
      if (table_[i].cell == kNoCell) {
        table_[i].cell = cell;
        ++count_;
        break;
      }
      i = (i + 1) & (table_.size() - 1);
    }
    return table_[i];
  }

  void grow() {
    std::vector<Met> old(4 * table_.size());
    old.swap(table_);
    count_ = 0;
    for (const Met& met : old)
      if (met.cell != kNoCell) place_of(met.cell) = met;
  }

  std::vector<Met> table_ = std::vector<Met>(2048);
  std::size_t count_ = 0;
};

}  // namespace ridgeway::detail
