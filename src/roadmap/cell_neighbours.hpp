// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>

#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway::detail {

/// Place of a cell in CellGraph::cells.
using CellId = std::uint32_t;
inline constexpr CellId kNoCell = 0xffffffffu;

/// From one of the eight cells of a block to the next cell in a direction.
struct OctantStep {
  Direction block;       ///< direction of that one's block; kCentre: the same block
  std::uint8_t octant;   ///< its place in there
  std::uint8_t crossed;  ///< a bit for each axis along which that block is another one
};
inline constexpr auto kOctantSteps = [] {
  std::array<std::array<OctantStep, 27>, CellGraph::kPerBlock> steps{};
  for (int octant = 0; octant < 8; ++octant)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex o = offset_of(d);
      const int x = (octant & 1) + o.x, y = (octant >> 1 & 1) + o.y, z = (octant >> 2) + o.z;
      steps[static_cast<std::size_t>(octant)][static_cast<std::size_t>(d)] = {
          static_cast<Direction>((x >> 1) + 1 + 3 * ((y >> 1) + 1) + 9 * ((z >> 1) + 1)),
          static_cast<std::uint8_t>((x & 1) | (y & 1) << 1 | (z & 1) << 2),
          static_cast<std::uint8_t>((x >> 1 & 1) | (y >> 1 & 1) << 1 | (z >> 1 & 1) << 2)};
    }
  return steps;
}();

/// Of the voxel at a place of a cell from the cell's first one.
constexpr VoxelIndex offset_of_place(std::uint8_t place) {
  return {place & 3, place >> 2 & 3, place >> 4};
}

/// Where the cells of a layout lie, and which are beside each other.
class CellLattice {
 public:
  explicit CellLattice(const BlockLayout& layout) : layout_(layout) {}

  /// The cell that holds a voxel, or kNoCell where its block is not allocated.
  CellId cell_of(const VoxelIndex& v) const {
    const std::uint32_t slot = layout_.find_block(block_of(v));
    if (slot == BlockLayout::kNoBlock) return kNoCell;
    return layout_.rank(slot) * CellGraph::kPerBlock + octant_of(v);
  }

  /// The first voxel of a cell.
  VoxelIndex first_voxel(CellId cell) const {
    const BlockIndex& b = layout_.block(layout_.slot_at(cell / CellGraph::kPerBlock));
    const auto bit = [&](unsigned k) { return CellGraph::kSide * static_cast<int>(cell >> k & 1); };
    return {kBlockSide * b.x + bit(0), kBlockSide * b.y + bit(1), kBlockSide * b.z + bit(2)};
  }

  /// The voxel at a place of a cell.
  VoxelIndex voxel_at(CellId cell, std::uint8_t place) const {
    return first_voxel(cell) + offset_of_place(place);
  }

  CellId neighbour(CellId cell, int direction) const {
    const OctantStep& step = step_from(cell, direction);
    const std::uint32_t rank = block_beside(cell, step);
    return rank == BlockLayout::kNoBlock ? kNoCell : rank * CellGraph::kPerBlock + step.octant;
  }

  /// Place in the order of all blocks of the one that a step from a cell leads to, or kNoBlock.
  std::uint32_t block_beside(CellId cell, const OctantStep& step) const {
    const std::uint32_t rank = cell / CellGraph::kPerBlock;
    if (step.block == kCentre) return rank;
    const std::uint32_t slot = layout_.neighbour_block(layout_.slot_at(rank), step.block);
    return slot == BlockLayout::kNoBlock ? slot : layout_.rank(slot);
  }

  static const OctantStep& step_from(CellId cell, int direction) {
    return kOctantSteps[cell % CellGraph::kPerBlock][static_cast<std::size_t>(direction)];
  }
  /// In which direction the block of that neighbour lies.
  static int block_direction(CellId cell, int direction) {
    return step_from(cell, direction).block;
  }

 private:
  static CellId octant_of(const VoxelIndex& v) {
    return static_cast<CellId>((v.x >> 2 & 1) | (v.y >> 2 & 1) << 1 | (v.z >> 2 & 1) << 2);
  }

  const BlockLayout& layout_;
};

/// Width of the edge from a cell to its neighbour in a direction, as CellGraph::Cell has it.
inline std::uint8_t edge_width(const std::vector<CellGraph::Cell>& cells, CellId from, CellId to,
                               int direction) {
  return direction > kCentre ? cells[from].widths[static_cast<std::size_t>(direction - kCentre - 1)]
                             : cells[to].widths[static_cast<std::size_t>(kCentre - 1 - direction)];
}

/// Lengths from landmarks to all blocks, where straight lines say little.
void place_cell_landmarks(const BlockLayout& layout, CellGraph& graph);

}  // namespace ridgeway::detail
