// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <bit>
#include <limits>

#include "best_first_search.hpp"
#include "cell_bends.hpp"
#include "cell_neighbours.hpp"
#include "cell_walks.hpp"
#include "paths/planning_constants.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

using Middle = Eigen::Vector3f;  // voxels
constexpr std::uint32_t kNone = 0xffffffffu;
constexpr float kUnreached = std::numeric_limits<float>::infinity();

/// The graph of cells seen from farther away: a node for each block that has cells, in the middle
/// of their places, linked as they are.
class BlockGraph {
 public:
  /// `least_width`: of the edges that count.
  BlockGraph(const BlockLayout& layout, const CellGraph& graph, std::uint8_t least_width)
      : layout_(layout),
        least_width_(least_width),
        middles_(layout.block_count()),
        links_(layout.block_count()),
        search_(layout.block_count(), kUnreached) {
    const CellLattice lattice(layout);
    const std::vector<CellGraph::Cell>& cells = graph.cells;
    for (std::uint32_t rank = 0; rank < links_.size(); ++rank) {
      float count = 0.0f;
      Middle sum = Middle::Zero();
      for (CellId cell = rank * CellGraph::kPerBlock; cell < (rank + 1) * CellGraph::kPerBlock;
           ++cell) {
        if (cells[cell].place == CellGraph::kNoPlace) continue;
        const VoxelIndex v = lattice.voxel_at(cell, cells[cell].place);
        sum += Middle(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
        count += 1.0f;
        link(cells[cell], cell, rank);
      }
      if (count > 0.0f) middles_[rank] = sum / count;
    }
    for (const CellGraph::Bend& bend : graph.bends)
      if (bend.width >= least_width)
        link(lattice, cell_of_place(graph, bend.from), cell_of_place(graph, bend.to));
  }

  /// Lengths of shortest ways from a block, which length() has then. The block farthest off.
  template <typename Visit>
  std::uint32_t search_from(std::uint32_t start, const Visit& visit) {
    std::uint32_t last = start;
    search_.restart();
    search_.offer(start, 0.0f, start);
    search_.run([&](std::uint32_t rank) {
      last = rank;
      visit(rank);
      for (std::uint32_t left = links_[rank]; left != 0; left &= left - 1) {
        const std::uint32_t slot =
            layout_.neighbour_block(layout_.slot_at(rank), std::countr_zero(left));
        const std::uint32_t next = layout_.rank(slot);
        search_.offer(next, search_.cost(rank) + (middles_[next] - middles_[rank]).norm(), rank);
      }
      return true;
    });
    return last;
  }
  float length(std::uint32_t rank) const { return search_.cost(rank); }

  /// Of the part that has the most blocks: the one farthest from the first; none without links.
  std::uint32_t farthest_in_largest_part() {
    std::vector<char> is_seen(links_.size());
    std::size_t most = 0;
    std::uint32_t farthest = kNone;
    for (std::uint32_t rank = 0; rank < links_.size(); ++rank) {
      if (links_[rank] == 0 || is_seen[rank] != 0) continue;
      std::size_t count = 0;
      const std::uint32_t last = search_from(rank, [&](std::uint32_t reached) {
        is_seen[reached] = 1;
        ++count;
      });
      if (count <= most) continue;
      most = count;
      farthest = last;
    }
    return farthest;
  }

 private:
  void link(const CellGraph::Cell& from, CellId cell, std::uint32_t rank) {
    for (int d = kCentre + 1; d < 27; ++d) {
      if (from.widths[static_cast<std::size_t>(d - kCentre - 1)] < least_width_) continue;
      const int beyond = CellLattice::block_direction(cell, d);
      if (beyond == kCentre) continue;
      links_[rank] |= 1u << beyond;
      const std::uint32_t slot = layout_.neighbour_block(layout_.slot_at(rank), beyond);
      links_[layout_.rank(slot)] |= 1u << opposite(beyond);
    }
  }

  /// One way; the bend back links the other.
  void link(const CellLattice& lattice, CellId from, CellId to) {
    for (const int axis : {0, 1, 2})
      for (const int d : {along(axis), opposite(along(axis))})
        if (lattice.neighbour(from, d) == to)
          if (const int beyond = CellLattice::block_direction(from, d); beyond != kCentre)
            links_[from / CellGraph::kPerBlock] |= 1u << beyond;
  }

  const BlockLayout& layout_;
  const std::uint8_t least_width_;
  std::vector<Middle> middles_;       // by rank
  std::vector<std::uint32_t> links_;  // by rank: a bit for each direction
  BestFirstSearch<std::uint32_t, float> search_;
};

/// The block farthest from another, then those farthest from all before.
void place_landmarks_from(std::uint32_t farthest, BlockGraph& blocks, CellGraph::Lengths& lengths) {
  std::vector<float> nearest(lengths.size(), kUnreached);  // of the landmarks so far
  for (std::size_t k = 0; k < CellGraph::kLandmarks; ++k) {
    float most = 0.0f;
    std::uint32_t next = farthest;
    blocks.search_from(farthest, [&](std::uint32_t rank) {
      const float length = blocks.length(rank);
      lengths[rank][k] = length;
      nearest[rank] = std::min(nearest[rank], length);
      if (nearest[rank] <= most) return;
      most = nearest[rank];
      next = rank;
    });
    farthest = next;
  }
}

}  // namespace

void place_cell_landmarks(const BlockLayout& layout, CellGraph& graph) {
  parallel_for_each_index(2, [&](std::size_t i) {
    CellGraph::Lengths& lengths = i == 0 ? graph.lengths : graph.lengths_wide;
    BlockGraph blocks(layout, graph, i == 0 ? 1 : kRadiusLevels.size());
    const std::uint32_t farthest = blocks.farthest_in_largest_part();
    if (farthest == kNone) return;
    CellGraph::Lengths::value_type nothing;
    nothing.fill(std::numeric_limits<float>::quiet_NaN());
    lengths.assign(layout.block_count(), nothing);
    place_landmarks_from(farthest, blocks, lengths);
  });
}

}  // namespace ridgeway::detail
