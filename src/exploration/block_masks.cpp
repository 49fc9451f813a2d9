// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "block_masks.hpp"

#include <algorithm>
#include <cstdint>

namespace ridgeway::detail {
namespace {

constexpr std::uint64_t kFirstColumn = 0x0101010101010101;  // x = 0 of all rows of a layer
constexpr std::uint64_t kLastColumn = kFirstColumn << 7;
constexpr std::uint64_t kFirstRow = 0xff;  // y = 0
constexpr std::uint64_t kLastRow = kFirstRow << 56;
constexpr std::size_t kTop = kBlockSide - 1;
static_assert(kBlockSide == 8);

std::uint64_t spread_x(std::uint64_t m) {
  return m | (m << 1 & ~kFirstColumn) | (m >> 1 & ~kLastColumn);
}
std::uint64_t spread_y(std::uint64_t m) { return m | m << 8 | m >> 8; }

}  // namespace

BlockMask mask_of(const EsdfMap& esdf, const BlockIndex& block, VoxelState state) {
  BlockMask mask{};
  const std::uint32_t slot = esdf.layout.find_block(block);
  if (slot == BlockLayout::kNoBlock) {
    if (state == VoxelState::kUnknown) mask.fill(~std::uint64_t{0});
    return mask;
  }
  const VoxelState* const states = esdf.state.block(slot);
  constexpr std::uint64_t kOnes = 0x0101010101010101;  // a row of eight states is one word
  for (std::size_t row = 0; row < 64; ++row) {
    std::uint64_t word = 0;
    for (std::size_t x = 0; x < 8; ++x)
      word |= std::uint64_t{static_cast<std::uint8_t>(states[8 * row + x])} << 8 * x;
    word ^= kOnes * static_cast<std::uint8_t>(state);  // 0 where it is the state, else 1 to 3
    const std::uint64_t is_state = ~(word | word >> 1) & kOnes;
    mask[row / 8] |= is_state * 0x0102040810204080 >> 56 << 8 * (row % 8);  // eight bits in a byte
  }
  return mask;
}

BlockMask mask_within(const BlockIndex& block, const VoxelIndex& min, const VoxelIndex& max) {
  const auto from = [](std::int64_t at, int low) {
    return static_cast<int>(std::clamp<std::int64_t>(low - at * kBlockSide, 0, kBlockSide));
  };
  const auto to = [&](std::int64_t at, int high) { return from(at, high + 1); };
  std::uint64_t row = 0;
  for (int x = from(block.x, min.x); x < to(block.x, max.x); ++x) row |= std::uint64_t{1} << x;
  std::uint64_t layer = 0;
  for (int y = from(block.y, min.y); y < to(block.y, max.y); ++y) layer |= row << 8 * y;
  BlockMask mask{};
  for (int z = from(block.z, min.z); z < to(block.z, max.z); ++z)
    mask[static_cast<std::size_t>(z)] = layer;
  return mask;
}

BlockMask touched_by(const BlockMask& mask, const VoxelIndex& step) {
  BlockMask flat{};  // along x and y
  for (std::size_t z = 0; z < flat.size(); ++z) {
    const std::uint64_t m = mask[z];
    const std::uint64_t by_x = step.x == 0  ? spread_x(m)
                               : step.x > 0 ? m >> 7 & kFirstColumn
                                            : (m & kFirstColumn) << 7;
    flat[z] = step.y == 0 ? spread_y(by_x) : step.y > 0 ? by_x >> 56 : (by_x & kFirstRow) << 56;
  }
  BlockMask touched{};
  if (step.z > 0) {
    touched[0] = flat[kTop];
  } else if (step.z < 0) {
    touched[kTop] = flat[0];
  } else {
    for (std::size_t z = 0; z < flat.size(); ++z)
      touched[z] = flat[z] | (z > 0 ? flat[z - 1] : 0) | (z < kTop ? flat[z + 1] : 0);
  }
  return touched;
}

BlockMask beside(const BlockMask& own, const BlockMask& beyond, Direction face) {
  const VoxelIndex& o = offset_of(face);
  BlockMask mask;
  for (std::size_t z = 0; z < mask.size(); ++z) {
    if (o.z != 0) {
      const bool is_last = z == (o.z > 0 ? kTop : 0);
      mask[z] = is_last ? beyond[kTop - z] : own[o.z > 0 ? z + 1 : z - 1];
    } else if (o.y != 0) {
      mask[z] = o.y > 0 ? own[z] >> 8 | beyond[z] << 56 : own[z] << 8 | beyond[z] >> 56;
    } else {
      mask[z] = o.x > 0 ? (own[z] >> 1 & ~kLastColumn) | (beyond[z] & kFirstColumn) << 7
                        : (own[z] << 1 & ~kFirstColumn) | (beyond[z] >> 7 & kFirstColumn);
    }
  }
  return mask;
}

bool reaches(const BlockMask& mask, Direction face) {
  const VoxelIndex& o = offset_of(face);
  if (o.z != 0) return mask[o.z > 0 ? kTop : 0] != 0;
  const std::uint64_t edge = o.y > 0   ? kLastRow
                             : o.y < 0 ? kFirstRow
                             : o.x > 0 ? kLastColumn
                                       : kFirstColumn;
  return std::any_of(mask.begin(), mask.end(),
                     [&](std::uint64_t layer) { return (layer & edge) != 0; });
}

BlockMask first_piece(const BlockMask& mask) {
  BlockMask piece{};
  for (std::size_t z = 0; z < mask.size(); ++z)
    if (mask[z] != 0) {
      piece[z] = mask[z] & (~mask[z] + 1);
      break;
    }
  while (true) {
    const BlockMask grown = both(touched_by(piece, VoxelIndex{}), mask);
    if (grown == piece) return piece;
    piece = grown;
  }
}

}  // namespace ridgeway::detail
