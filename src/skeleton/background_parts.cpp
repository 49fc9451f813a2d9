// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "background_parts.hpp"

#include <algorithm>
#include <tuple>

#include "ridgeway/common/parallel.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

using Block = VoxelMask::Block;

constexpr std::uint64_t kFirstX = 0x0101010101010101u, kLastX = kFirstX << 7;
constexpr std::uint64_t kFirstY = 0xffu, kLastY = kFirstY << 56;

/// Voxels of a layer that are reached from `seed` by steps across faces in the layer.
std::uint64_t flood_layer(std::uint64_t seed, std::uint64_t within) {
  for (;;) {
    const std::uint64_t grown =
        (seed | seed << 8 | seed >> 8 | (seed & ~kLastX) << 1 | (seed & ~kFirstX) >> 1) & within;
    if (grown == seed) return seed;
    seed = grown;
  }
}

/// Those of a block.
Block flood_block(std::size_t layer, std::uint64_t seed, const Block& within) {
  Block reached{};
  reached[layer] = flood_layer(seed, within[layer]);
  for (bool again = true; again;) {
    again = false;
    const auto take_from = [&](std::size_t z, std::size_t beside) {
      const std::uint64_t fresh = reached[beside] & within[z] & ~reached[z];
      if (fresh == 0) return;
      reached[z] = flood_layer(reached[z] | fresh, within[z]);
      again = true;
    };
    for (std::size_t z = 1; z < kBlockSide; ++z) take_from(z, z - 1);
    for (std::size_t z = kBlockSide - 1; z-- > 0;) take_from(z, z + 1);
  }
  return reached;
}

/// The parts of a block's voxels that hang together by faces inside it.
std::vector<Block> parts_of_block(Block left) {
  std::vector<Block> parts;
  for (std::size_t z = 0; z < kBlockSide; ++z)
    while (left[z] != 0) {
      parts.push_back(flood_block(z, left[z] & (~left[z] + 1), left));
      for (std::size_t k = z; k < kBlockSide; ++k) left[k] &= ~parts.back()[k];
    }
  return parts;
}

/// Whether two parts touch, the second in the next block along an axis.
bool touch(const Block& a, const Block& b, int axis) {
  if (axis == 2) return (a[kBlockSide - 1] & b[0]) != 0;
  for (std::size_t z = 0; z < kBlockSide; ++z)
    if (((axis == 0 ? (a[z] & kLastX) >> 7 : a[z] >> 56) & b[z] &
         (axis == 0 ? kFirstX : kFirstY)) != 0)
      return true;
  return false;
}

/// Whether a part touches the side of its block to which a face direction leads.
bool touches_side(const Block& part, Direction direction) {
  const VoxelIndex o = offset_of(direction);
  if (o.z != 0) return part[o.z < 0 ? 0 : kBlockSide - 1] != 0;
  const std::uint64_t side = o.x < 0 ? kFirstX : o.x > 0 ? kLastX : o.y < 0 ? kFirstY : kLastY;
  return std::any_of(part.begin(), part.end(),
                     [&](std::uint64_t layer) { return (layer & side) != 0; });
}

}  // namespace

BackgroundParts::BackgroundParts(const BlockLayout& layout, const VoxelMask& voxels)
    : layout_(layout) {
  find_blocks(voxels);
  find_gaps();
  find_parts(voxels);
  const std::uint32_t count = first_part_.back();
  sets_ = DisjointSets(count);
  join_gaps();
  join_parts();
  const std::uint32_t around = sets_.find(0);
  for (std::uint32_t i = 0; i < count; ++i) is_one_ &= sets_.find(i) == around;
}

void BackgroundParts::find_blocks(const VoxelMask& voxels) {
  place_of_.assign(layout_.block_count(), BlockLayout::kNoBlock);
  for (const std::uint32_t slot : voxels.slots_in_order(layout_)) {
    if (is_empty(voxels.block(slot))) continue;
    place_of_[slot] = static_cast<std::uint32_t>(slots_.size());
    slots_.push_back(slot);
  }
}

void BackgroundParts::find_gaps() {
  for (const std::uint32_t slot : slots_) {
    const BlockIndex& b = layout_.block(slot);
    if (rows_.empty() || rows_.back().y != b.y || rows_.back().z != b.z)
      rows_.push_back({b.y, b.z, b.x, b.x, static_cast<std::uint32_t>(gaps_.size()), 0});
    Row& row = rows_.back();
    if (b.x > row.last_x + 1) {
      gaps_.push_back({row.last_x + 1, b.x - 1});
      ++row.gaps;
    }
    row.last_x = b.x;
  }
}

/// Gaps of neighbouring rows that overlap are one, and one that reaches beyond the blocks of a
/// neighbouring row is open to what is around.
void BackgroundParts::join_gaps() {
  for (const Row& row : rows_)
    for (std::uint32_t g = row.first_gap; g < row.first_gap + row.gaps; ++g)
      for (const auto& [dy, dz] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        const Gap& gap = gaps_[g];
        const Row* other = row_at(row.y + dy, row.z + dz);
        if (other == nullptr || gap.first_x < other->first_x || gap.last_x > other->last_x)
          sets_.join(0, g + 1);
        if (other == nullptr) continue;
        for (std::uint32_t o = other->first_gap; o < other->first_gap + other->gaps; ++o)
          if (gaps_[o].first_x <= gap.last_x && gap.first_x <= gaps_[o].last_x)
            sets_.join(g + 1, o + 1);
      }
}

void BackgroundParts::find_parts(const VoxelMask& voxels) {
  parts_.resize(slots_.size());
  parallel_for_each_index(
      slots_.size(),
      [&](std::size_t place) {
        Block background = voxels.block(slots_[place]);
        for (std::uint64_t& layer : background) layer = ~layer;
        parts_[place] = parts_of_block(background);
      },
      16);
  first_part_.push_back(static_cast<std::uint32_t>(gaps_.size()) + 1);
  for (const std::vector<Block>& parts : parts_)
    first_part_.push_back(first_part_.back() + static_cast<std::uint32_t>(parts.size()));
}

void BackgroundParts::join_parts() {
  for (std::uint32_t place = 0; place < slots_.size(); ++place)
    for (const Direction d : kFaceDirections) {
      const VoxelIndex o = offset_of(d);
      const std::uint32_t beside = place_of(layout_.neighbour_block(slots_[place], d));
      for (std::uint32_t i = 0; i < parts_[place].size(); ++i) {
        const std::uint32_t own = first_part_[place] + i;
        if (beside == BlockLayout::kNoBlock) {
          if (touches_side(parts_[place][i], d))
            sets_.join(own,
                       number_outside(layout_.block(slots_[place]) + BlockIndex{o.x, o.y, o.z}));
        } else if (d > kCentre) {
          const int axis = o.x != 0 ? 0 : o.y != 0 ? 1 : 2;
          for (std::uint32_t k = 0; k < parts_[beside].size(); ++k)
            if (touch(parts_[place][i], parts_[beside][k], axis))
              sets_.join(own, first_part_[beside] + k);
        }
      }
    }
}

const BackgroundParts::Row* BackgroundParts::row_at(int y, int z) const {
  const auto row = std::lower_bound(
      rows_.begin(), rows_.end(), std::pair(z, y),
      [](const Row& r, const std::pair<int, int>& at) { return std::pair(r.z, r.y) < at; });
  return row != rows_.end() && row->y == y && row->z == z ? &*row : nullptr;
}

std::uint32_t BackgroundParts::number_outside(const BlockIndex& block) const {
  const Row* row = row_at(block.y, block.z);
  if (row == nullptr || block.x < row->first_x || block.x > row->last_x) return 0;
  const auto first = gaps_.begin() + row->first_gap;
  const auto gap = std::partition_point(first, first + row->gaps,
                                        [&](const Gap& g) { return g.last_x < block.x; });
  return static_cast<std::uint32_t>(gap - gaps_.begin()) + 1;
}

std::uint32_t BackgroundParts::number_of(const VoxelIndex& voxel) const {
  const std::uint32_t place = place_of(layout_.find_block(block_of(voxel)));
  if (place == BlockLayout::kNoBlock) return number_outside(block_of(voxel));
  const int local = local_of(voxel);
  std::uint32_t i = 0;
  while ((parts_[place][i][static_cast<std::size_t>(local / 64)] >> (local % 64) & 1) == 0) ++i;
  return first_part_[place] + i;
}

}  // namespace ridgeway::detail
