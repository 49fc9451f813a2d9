// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {

/// All of traversable space, coarsely: cubes of 4 x 4 x 4 voxels, in each one place to pass, and
/// straight segments between the places of neighbouring cells. Where space is open it knows the
/// sides on which obstacles can be passed, at any radius, which curves through the middle of space
/// do not. Narrow places may be missing: what it does not connect, the sparse graph does.
/// Not in the file: found when a roadmap is built or loaded.
struct CellGraph {
  static constexpr int kSide = 4;      ///< of a cell, voxels
  static constexpr int kPerBlock = 8;  ///< cells
  static constexpr std::uint8_t kNoPlace = 64;
  static constexpr std::uint16_t kNoPart = 0xffff;  ///< no part, or one of too many
  static constexpr int kCodesPerRadius = 8;         ///< steps of an edge's clearance

  struct Cell {
    std::uint8_t place = kNoPlace;  ///< the voxel in the cell, x fastest
    /// Clearance of the edges in the directions 14 to 26 (voxel/neighbourhood.hpp), rounded down,
    /// in eighths of the smallest radius; 0: no edge. The cell beyond has those of the others.
    std::array<std::uint8_t, 13> clearance{};
    std::uint16_t part = kNoPart;  ///< connected part of this graph
  };
  std::vector<Cell> cells;  ///< by block in order (BlockLayout::rank), then x, y, z in the block
};

/// Every segment is verified by the free-space predicate. Deterministic.
CellGraph build_cell_graph(const EsdfMap& esdf, double min_clearance);

}  // namespace ridgeway
