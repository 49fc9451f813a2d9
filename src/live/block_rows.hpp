// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// In place of a way along a line: there is none.
inline constexpr std::int16_t kNoWay = std::numeric_limits<std::int16_t>::max();

/// How far an obstacle counts: voxels along a line, and 4 d^2 at most.
struct SweepReach {
  int voxels = 0;
  std::uint32_t limit = 0;
};
/// `farthest`: longest distance that is asked for, voxels; may be infinite.
SweepReach reach_of(double farthest);

/// A straight row of blocks without a gap, or a piece of it.
struct BlockRow {
  std::vector<std::uint32_t> slots;
  std::vector<std::size_t> due;  ///< places in `slots` of the blocks for which the row was made
  bool is_begin = false;         ///< no block comes before the first
  bool is_end = false;           ///< nor after the last
};

/// Line `line` (0..63) of a row's voxels along its axis.
class RowLine {
 public:
  RowLine() = default;
  RowLine(const BlockRow& row, int axis, int line) : slots_(row.slots), shift_(axis * kBlockBits) {
    const auto low = static_cast<VoxelId>(line & 7), high = static_cast<VoxelId>(line >> 3);
    base_ = axis == 0 ? low << 3 | high << 6 : axis == 1 ? low | high << 6 : low | high << 3;
  }

  int size() const { return static_cast<int>(slots_.size()) * kBlockSide; }
  VoxelId voxel(int place) const {
    const auto p = static_cast<std::uint32_t>(place);
    return slots_[p / kBlockSide] * kBlockVoxels + base_ + (p % kBlockSide << shift_);
  }

 private:
  std::span<const std::uint32_t> slots_;
  VoxelId base_ = 0;
  int shift_ = 0;
};

/// The blocks lane by lane, that is by line of blocks along an axis, ascending along each.
std::vector<std::vector<std::uint32_t>> by_lane(const BlockLayout& layout,
                                                std::span<const std::uint32_t> slots, int axis);

/// The row around the first blocks of a lane, as far as `margin` voxels beyond them, and which of
/// the blocks it holds: those before `next`, where the next row begins.
BlockRow row_around(const BlockLayout& layout, std::span<const std::uint32_t> lane, int axis,
                    int margin, std::size_t& next);

/// Calls body(row) for rows that hold all blocks of a lane, each in one of them, and reach as far
/// as `margin` voxels beyond them, or to where the layout ends.
template <typename Body>
void for_each_row_around(const BlockLayout& layout, std::span<const std::uint32_t> lane, int axis,
                         int margin, const Body& body) {
  for (std::size_t next = 0; next < lane.size();)
    body(row_around(layout, lane, axis, margin, next));
}

/// A bit for each line along an axis of a row (numbered as for RowLine) that holds members of a
/// mask in those of its blocks that are due.
std::uint64_t due_lines(const BlockRow& row, const VoxelMask& mask, int axis);

/// The places of a mask's members on a line of a row, in those of its blocks that are due.
void due_places(const BlockRow& row, const VoxelMask& mask, int axis, int line,
                std::vector<int>& places);

}  // namespace ridgeway::detail
