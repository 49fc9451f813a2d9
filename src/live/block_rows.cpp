// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "block_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

#include "esdf/site_limit.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::array<int, 3> kForward{14, 16, 22};

/// Where a block lies across an axis, and then along it.
std::tuple<int, int, int> lane_order(const BlockIndex& b, int axis) {
  return axis == 0   ? std::tuple(b.z, b.y, b.x)
         : axis == 1 ? std::tuple(b.z, b.x, b.y)
                     : std::tuple(b.y, b.x, b.z);
}

bool same_lane(const BlockIndex& a, const BlockIndex& b, int axis) {
  const BlockIndex o = a - b;
  return (axis == 0 || o.x == 0) && (axis == 1 || o.y == 0) && (axis == 2 || o.z == 0);
}

/// A bit for each member on the line in a block, by place along it.
unsigned bits_on_line(const VoxelMask::Block& block, int axis, int line) {
  const auto low = static_cast<unsigned>(line & 7), high = static_cast<unsigned>(line >> 3);
  if (axis == 0) return static_cast<unsigned>(block[high] >> (8 * low)) & 0xffu;
  unsigned bits = 0;
  for (unsigned i = 0; i < kBlockSide; ++i) {
    const std::uint64_t layer = axis == 1 ? block[high] : block[i];
    bits |= static_cast<unsigned>(layer >> (low + 8 * (axis == 1 ? i : high)) & 1) << i;
  }
  return bits;
}

/// A bit for each line along an axis that holds members of a block, by its number.
std::uint64_t lines_in_block(const VoxelMask::Block& block, int axis) {
  std::uint64_t lines = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    std::uint64_t layer = block[z];
    if (axis == 2) {
      lines |= layer;
    } else if (axis == 1) {  // rows united in the lowest byte
      for (const int shift : {32, 16, 8}) layer |= layer >> shift;
      lines |= (layer & 0xffu) << (8 * z);
    } else {  // each row united in its lowest bit; the product gathers these in the highest byte
      for (const int shift : {4, 2, 1}) layer |= layer >> shift;
      lines |= ((layer & 0x0101010101010101u) * 0x0102040810204080u >> 56) << (8 * z);
    }
  }
  return lines;
}

}  // namespace

SweepReach reach_of(double farthest) {
  return {static_cast<int>(std::ceil(site_limit(farthest))) + 1, largest_kept(farthest)};
}

std::vector<std::vector<std::uint32_t>> by_lane(const BlockLayout& layout,
                                                std::span<const std::uint32_t> slots, int axis) {
  std::vector<std::uint32_t> sorted(slots.begin(), slots.end());
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    return lane_order(layout.block(a), axis) < lane_order(layout.block(b), axis);
  });
  std::vector<std::vector<std::uint32_t>> lanes;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || !same_lane(layout.block(sorted[i - 1]), layout.block(sorted[i]), axis))
      lanes.emplace_back();
    lanes.back().push_back(sorted[i]);
  }
  return lanes;
}

BlockRow row_around(const BlockLayout& layout, std::span<const std::uint32_t> lane, int axis,
                    int margin, std::size_t& next) {
  const int forward = kForward[static_cast<std::size_t>(axis)];
  const int most = margin / kBlockSide + 1;  // blocks beyond
  BlockRow row;
  std::uint32_t before = layout.neighbour_block(lane[next], opposite(forward));
  for (int i = 0; i < most && before != BlockLayout::kNoBlock; ++i) {
    row.slots.push_back(before);
    before = layout.neighbour_block(before, opposite(forward));
  }
  std::reverse(row.slots.begin(), row.slots.end());
  row.is_begin = before == BlockLayout::kNoBlock;
  std::uint32_t at = lane[next];
  for (int left = most; at != BlockLayout::kNoBlock && left >= 0; --left) {
    if (next < lane.size() && lane[next] == at) {
      row.due.push_back(row.slots.size());
      ++next;
      left = most;
    }
    row.slots.push_back(at);
    at = layout.neighbour_block(at, forward);
  }
  row.is_end = at == BlockLayout::kNoBlock;
  return row;
}

std::uint64_t due_lines(const BlockRow& row, const VoxelMask& mask, int axis) {
  std::uint64_t lines = 0;
  for (const std::size_t i : row.due) lines |= lines_in_block(mask.block(row.slots[i]), axis);
  return lines;
}

void due_places(const BlockRow& row, const VoxelMask& mask, int axis, int line,
                std::vector<int>& places) {
  places.clear();
  for (const std::size_t i : row.due)
    for (unsigned bits = bits_on_line(mask.block(row.slots[i]), axis, line); bits != 0;
         bits &= bits - 1)
      places.push_back(static_cast<int>(i) * kBlockSide + std::countr_zero(bits));
}

}  // namespace ridgeway::detail
