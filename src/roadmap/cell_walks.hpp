// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cell_neighbours.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Some of the 64 voxels of a cell: bit x + 4 y + 16 z, as CellGraph::Cell numbers places.
using CellMask = std::uint64_t;
constexpr CellMask bit_of(std::uint8_t place) { return CellMask{1} << place; }

/// A place of a cell, counted from the first voxel of the cell's block.
constexpr std::uint32_t local_voxel(CellId cell, std::uint32_t place) {
  const auto coordinate = [&](unsigned axis) {
    return (cell >> axis & 1u) * CellGraph::kSide + (place >> 2 * axis & 3u);
  };
  return coordinate(0) | coordinate(1) << kBlockBits | coordinate(2) << 2 * kBlockBits;
}

/// The voxels of a cell that the robot fits on, between any two of which that share a face it can
/// move.
CellMask fitting_voxels(const FreeSpace& space, CellId cell, SquaredHalves threshold);

/// The voxels that moves across faces lead to from others, all within `room`.
CellMask flood(CellMask from, CellMask room);

/// The voxels that a move leads to from those of a cell, in the same cell (`step` kCentre) or in
/// the next one in a direction, along each axis of which the move goes.
CellMask voxels_moved(CellMask voxels, int step, int move);

/// Voxels of a cell and of the next one along an axis.
struct CellPair {
  CellMask first = 0, second = 0;
  bool meets(const CellPair& other) const {
    return ((first & other.first) | (second & other.second)) != 0;
  }
  friend bool operator==(const CellPair&, const CellPair&) = default;
};

/// Moves across faces within two cells, or within the first alone where there is no room in the
/// second. Places of the second are numbered on from 64.
class CellWalks {
 public:
  CellWalks(const CellPair& room, int axis) : room_(room), axis_(axis) {}

  bool connect(std::uint8_t from, std::uint8_t to) const;
  /// The places on a shortest walk, both ends included, that changes its direction wherever it can
  /// and so keeps near the straight line; none where there is no walk.
  std::vector<std::uint8_t> walk(std::uint8_t from, std::uint8_t to) const;

 private:
  CellPair spread(const CellPair& voxels) const;
  CellPair room_;
  int axis_;
};

/// Length of such a walk, voxels, with steps along two or three axes in a row taken as one.
float length_of_walk(const std::vector<std::uint8_t>& walk, int axis);

/// A place as a step from the first voxel of the first cell.
VoxelIndex step_to(std::uint8_t place, int axis);

/// The direction of the next cell along an axis.
constexpr int along(int axis) { return axis == 0 ? 14 : axis == 1 ? 16 : 22; }

}  // namespace ridgeway::detail
