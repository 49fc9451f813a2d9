// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway::detail {

/// Blocks halved along the longest side of the box around them, each half again, down to a few:
/// what is near is found without a look at all of them, however far it is.
class BlockTree {
 public:
  BlockTree() = default;
  explicit BlockTree(std::vector<BlockIndex> blocks) : blocks_(std::move(blocks)) {
    if (!blocks_.empty()) grow(0, blocks_.size());
  }
  bool empty() const { return blocks_.empty(); }

  /// The distance to what is nearest of all that is in the blocks, or `best` where nothing is
  /// nearer. `bound(first, last)`: a lower bound of it, of all blocks from one to the other;
  /// `visit(block, best)`: the distance to what is in a block, or `best`.
  template <typename Bound, typename Visit>
  double search(double best, const Bound& bound, const Visit& visit) const {
    if (empty()) return best;
    const auto bound_of = [&](std::size_t node) {
      return bound(nodes_[node].low, nodes_[node].high);
    };
    // A node and the other halves on the way to it: as many as blocks can be halved.
    std::array<std::pair<double, std::size_t>, 2 + kMostHalvings> open;
    std::size_t count = 0;
    open[count++] = {bound_of(0), 0};
    while (count > 0) {
      const auto [distance, index] = open[--count];
      if (distance >= best) continue;
      const Node& node = nodes_[index];
      if (node.other_half == 0) {
        for (std::size_t i = node.begin; i < node.end; ++i)
          if (bound(blocks_[i], blocks_[i]) < best) best = visit(blocks_[i], best);
        continue;
      }
      std::pair<double, std::size_t> near{bound_of(index + 1), index + 1};
      std::pair<double, std::size_t> far{bound_of(node.other_half), node.other_half};
      if (far.first < near.first) std::swap(near, far);
      open[count++] = far;
      open[count++] = near;
    }
    return best;
  }

 private:
  static constexpr std::size_t kFew = 4, kMostHalvings = 32;

  struct Node {
    BlockIndex low, high;
    std::uint32_t begin, end;      ///< its blocks
    std::uint32_t other_half = 0;  ///< node; the first one follows itself. 0: not halved
  };

  void grow(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    const std::span<BlockIndex> own(blocks_.data() + begin, end - begin);
    BlockIndex low = own.front(), high = low;
    for (const BlockIndex& b : own) {
      low = {std::min(low.x, b.x), std::min(low.y, b.y), std::min(low.z, b.z)};
      high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
    }
    nodes_.push_back(
        {low, high, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    if (own.size() <= kFew) return;
    const BlockIndex side = high - low;
    const auto halve_along = [&](int BlockIndex::*axis) {
      std::nth_element(
          own.begin(), own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2), own.end(),
          [axis](const BlockIndex& a, const BlockIndex& b) { return a.*axis < b.*axis; });
    };
    halve_along(side.x >= side.y && side.x >= side.z ? &BlockIndex::x
                : side.y >= side.z                   ? &BlockIndex::y
                                                     : &BlockIndex::z);
    grow(begin, begin + own.size() / 2);
    nodes_[index].other_half = static_cast<std::uint32_t>(nodes_.size());
    grow(begin + own.size() / 2, end);
  }

  std::vector<BlockIndex> blocks_;
  std::vector<Node> nodes_;
};

}  // namespace ridgeway::detail
