// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cylinder_room.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "cylinder_scan.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::array<std::uint64_t, kBlockSide> kNothing{};
constexpr std::array<std::uint64_t, kBlockSide> kAll = [] {
  std::array<std::uint64_t, kBlockSide> all{};
  all.fill(~std::uint64_t{0});
  return all;
}();

/// 4 d^2 / s^2 to what is so many voxels away along an axis, at most `most`.
int squared_gap(int voxels, int most) {
  const int halves = std::max(2 * std::abs(voxels) - 1, 0);
  return halves < 256 ? std::min(halves * halves, most) : most;
}

/// For each of the eight voxels of a row in the middle of `bytes`, a bit for each obstacle of the
/// row, x upwards: the room beside the nearest obstacle of the row, at most `most`.
std::array<int, kBlockSide> room_in_row(const std::vector<std::uint8_t>& bytes, int most) {
  constexpr int kFar = 1 << 20;
  const std::size_t middle = bytes.size() / 2;
  const unsigned own = bytes[middle];
  int before = -kFar, behind = kFar;  // the nearest obstacles beside the eight
  for (std::size_t i = 1; i <= middle && before == -kFar; ++i)
    if (const unsigned bits = bytes[middle - i]; bits != 0)
      before = std::bit_width(bits) - 1 - kBlockSide * static_cast<int>(i);
  for (std::size_t i = 1; i <= middle && behind == kFar; ++i)
    if (const unsigned bits = bytes[middle + i]; bits != 0)
      behind = std::countr_zero(bits) + kBlockSide * static_cast<int>(i);
  std::array<int, kBlockSide> room{};
  for (int x = 0; x < kBlockSide; ++x) {
    if ((own >> x & 1) != 0) before = x;
    room[static_cast<std::size_t>(x)] = x - before;
  }
  for (int x = kBlockSide - 1; x >= 0; --x) {
    if ((own >> x & 1) != 0) behind = x;
    int& gap = room[static_cast<std::size_t>(x)];
    gap = squared_gap(std::min(gap, behind - x), most);
  }
  return room;
}

}  // namespace

CylinderRoom::CylinderRoom(const EsdfMap& esdf, double radius, double half_height) : esdf_(esdf) {
  constexpr double kTallest = 1000.0;  // voxels
  // Obstacles that are left out at one end of a move are far enough from the other, too.
  constexpr double kBeyond = 2.5;
  const double within = 2.0 * radius * (1.0 - kCylinderRounding);
  const double half = half_height * (1.0 - kCylinderRounding);
  if (within * within >= kWide || half >= kTallest) return;
  least_ = within * within;
  reach_ = static_cast<int>(std::ceil((radius + kBeyond) / kBlockSide));
  up_ = static_cast<int>(std::ceil(half + 0.5)) - 1;
}

CylinderRoom::Answer CylinderRoom::ask(VoxelId from, VoxelId to) {
  constexpr int kFew = 100;  // blocks are dearer than single moves
  if (reach_ == 0) return Answer::kUnclear;
  if (asked_ < kFew) {
    ++asked_;
    return Answer::kUnclear;
  }
  Room own = at(from), next = at(to);
  if (own < least_ || next < least_) return Answer::kShut;
  const VoxelIndex o = esdf_.layout.index_of(to) - esdf_.layout.index_of(from);
  const int axes = std::abs(o.x) + std::abs(o.y);  // of the plane
  if (o.z != 0 && axes != 0) {
    own = std::min(own, at(esdf_.layout.step(from, 0, 0, o.z)));
    next = std::min(next, at(esdf_.layout.step(to, 0, 0, -o.z)));
  }
  const SquaredHalves bound =
      axes < 2 ? SquaredHalves(std::min(own, next))
               : FreeSpace::move_bound(SquaredHalves(own), SquaredHalves(next), axes);
  return bound.value >= least_ ? Answer::kFree : Answer::kUnclear;
}

CylinderRoom::Room CylinderRoom::at(VoxelId id) {
  if (id == kNoVoxel) return 0;
  if (rooms_.empty()) rooms_.resize(esdf_.layout.block_count());
  const std::uint32_t slot = id / kBlockVoxels;
  if (rooms_[slot] == nullptr)
    rooms_[slot] = std::make_unique<Block>(room_of(esdf_.layout.block(slot)));
  return (*rooms_[slot])[id >> 6 & 7][id & 63];
}

CylinderRoom::Block CylinderRoom::room_of(const BlockIndex& block) {
  Block room;
  for (Layer& layer : room) layer.fill(kWide);
  const int blocks = (up_ + kBlockSide - 1) / kBlockSide;
  for (int beyond = -blocks; beyond <= blocks; ++beyond) {
    const Block layers = layers_at({block.x, block.y, block.z + beyond});
    for (int z = 0; z < kBlockSide; ++z)
      for (int from = 0; from < kBlockSide; ++from) {
        if (std::abs(kBlockSide * beyond + from - z) > up_) continue;
        Layer& own = room[static_cast<std::size_t>(z)];
        const Layer& other = layers[static_cast<std::size_t>(from)];
        for (std::size_t i = 0; i < own.size(); ++i) own[i] = std::min(own[i], other[i]);
      }
  }
  return room;
}

CylinderRoom::Block CylinderRoom::layers_at(const BlockIndex& block) {
  const std::uint32_t slot = esdf_.layout.find_block(block);
  if (slot == BlockLayout::kNoBlock) return find_layers(block);
  if (layers_.empty()) layers_.resize(esdf_.layout.block_count());
  if (layers_[slot] == nullptr) layers_[slot] = std::make_unique<Block>(find_layers(block));
  return *layers_[slot];
}

CylinderRoom::Block CylinderRoom::find_layers(const BlockIndex& block) const {
  const int side = 2 * reach_ + 1;
  std::vector<const std::uint64_t*> around;  // the obstacles of the blocks around, x fastest
  for (int dy = -reach_; dy <= reach_; ++dy)
    for (int dx = -reach_; dx <= reach_; ++dx) {
      const std::uint32_t slot = esdf_.layout.find_block({block.x + dx, block.y + dy, block.z});
      around.push_back(slot != BlockLayout::kNoBlock ? esdf_.obstacle.block(slot).data()
                       : esdf_.is_obstacle(kNoVoxel) ? kAll.data()
                                                     : kNothing.data());
    }
  Block layers;
  std::vector<std::uint8_t> row(static_cast<std::size_t>(side));
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    layers[z].fill(kWide);
    for (int y = -kBlockSide * reach_; y < kBlockSide * (reach_ + 1); ++y) {
      const auto first = static_cast<std::size_t>(((y >> kBlockBits) + reach_) * side);
      unsigned any = 0;
      for (std::size_t i = 0; i < row.size(); ++i)
        any |= row[i] = static_cast<std::uint8_t>(around[first + i][z] >> 8 * (y & 7));
      if (any == 0) continue;
      const std::array<int, kBlockSide> across = room_in_row(row, kWide);
      for (int own = 0; own < kBlockSide; ++own) {
        const int along = squared_gap(own - y, kWide);
        for (std::size_t x = 0; x < kBlockSide; ++x) {
          Room& room = layers[z][kBlockSide * static_cast<std::size_t>(own) + x];
          room = static_cast<Room>(std::min<int>(room, across[x] + along));
        }
      }
    }
  }
  return layers;
}

}  // namespace ridgeway::detail
