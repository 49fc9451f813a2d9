// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "thinning_memory.hpp"

#include <bit>

#include "thin_among.hpp"
#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

// A code is a pass and a round in a byte; the sub-field is the voxel's own.
constexpr std::uint32_t kRounds = 127;  // of a pass, that have a code
constexpr std::uint8_t kStays = 127, kIsLong = 255;

constexpr std::uint32_t kFirstLevel = 1;  // of a turn in the first pass

Turn turn_in(std::uint32_t pass, std::uint32_t round, VoxelId id) {
  return turn_at(kFirstLevel + pass, round, sub_field(id));
}

Turn turn_of_code(std::uint8_t code, VoxelId id) {
  if (code == kStays) return kNever;
  return code < kStays ? turn_in(0, code, id) : turn_in(1, code - kStays - 1u, id);
}

std::uint8_t code_of(Turn turn) {
  if (turn == kNever) return kStays;
  const std::uint32_t round = round_of_turn(turn);
  if (round >= kRounds) return kIsLong;
  const bool is_first = level_of_turn(turn) == kFirstLevel;
  return static_cast<std::uint8_t>(is_first ? round : kStays + 1u + round);
}

}  // namespace

/// Thinning as turns: a pass is a level, and all that is left is asked at the beginning of each.
struct ThinningMemory::Rule {
  const ThinningMemory& memory;
  const VoxelMask& voxels;

  const VoxelMask& space() const { return voxels; }
  Turn first_turn(VoxelId id) const { return turn_in(0, 0, id); }
  Turn later_turn(VoxelId id, Turn turn) const {
    const Turn second = turn_in(1, 0, id);
    return second > turn ? second : kNever;
  }
  Turn base_turn(VoxelId id) const { return memory.turn_of(voxels, id); }
  bool may_go(VoxelId, Cube27 cube, Turn turn) const {
    return may_be_thinned(level_of_turn(turn) - kFirstLevel, cube);
  }
};

std::size_t ThinningMemory::place_of(const VoxelMask& voxels, VoxelId id) const {
  return members_before(voxels.block(id / kBlockVoxels), id);
}

Turn ThinningMemory::turn_of(const VoxelMask& voxels, VoxelId id) const {
  const std::uint8_t code = codes_[id / kBlockVoxels][place_of(voxels, id)];
  return code == kIsLong ? long_.at(id, mixed(id)) : turn_of_code(code, id);
}

void ThinningMemory::set_turn(const VoxelMask& voxels, VoxelId id, Turn turn) {
  std::uint8_t& code = codes_[id / kBlockVoxels][place_of(voxels, id)];
  if (code == kIsLong) long_.erase(id, mixed(id));
  code = code_of(turn);
  if (code == kIsLong) long_.add(id, mixed(id), turn);
}

void ThinningMemory::thin(const BlockLayout& layout, const VoxelMask& voxels,
                          const VoxelMask& changed, std::span<const std::uint32_t> slots,
                          VoxelMask& thinned) {
  codes_.resize(layout.block_count());
  scratch_.grow(layout);
  std::size_t came = 0, went = 0;
  for (const std::uint32_t slot : slots)
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t layer = changed.block(slot)[z];
      came += static_cast<std::size_t>(bit_count(layer & voxels.block(slot)[z]));
      went += static_cast<std::size_t>(bit_count(layer & ~voxels.block(slot)[z]));
    }
  count_ += came - went;
  for (const std::uint32_t slot : slots) make_room(voxels, changed, slot);
  if (2 * came > count_)
    thin_all(layout, voxels, thinned);
  else
    thin_again(layout, voxels, changed, slots, thinned);
}

/// Codes of a block in which voxels came or went; those of voxels that came do not count yet.
void ThinningMemory::make_room(const VoxelMask& voxels, const VoxelMask& changed,
                               std::uint32_t slot) {
  const VoxelMask::Block& now = voxels.block(slot);
  VoxelMask::Block before = now;
  for (std::size_t z = 0; z < kBlockSide; ++z) before[z] ^= changed.block(slot)[z];
  std::vector<std::uint8_t> codes(count_of(now), kStays);
  std::size_t old_place = 0, place = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z)
    for (std::uint64_t either = before[z] | now[z]; either != 0; either &= either - 1) {
      const std::uint64_t bit = either & (~either + 1);
      const bool was = (before[z] & bit) != 0, is = (now[z] & bit) != 0;
      const auto id = static_cast<VoxelId>(slot * kBlockVoxels + 64 * z +
                                           static_cast<std::size_t>(std::countr_zero(bit)));
      if (was && is) codes[place] = codes_[slot][old_place];
      if (was && !is && codes_[slot][old_place] == kIsLong) long_.erase(id, mixed(id));
      old_place += was;
      place += is;
    }
  codes_[slot] = std::move(codes);
}

void ThinningMemory::thin_all(const BlockLayout& layout, const VoxelMask& voxels,
                              VoxelMask& thinned) {
  long_.clear();
  for (std::vector<std::uint8_t>& codes : codes_) codes.assign(codes.size(), kStays);
  thinned = voxels;
  thin_among(layout, thinned, voxels.members(layout),
             [&](std::uint32_t pass, std::uint32_t round, const std::vector<VoxelId>& deleted) {
               for (const VoxelId id : deleted) set_turn(voxels, id, turn_in(pass, round, id));
             });
}

void ThinningMemory::thin_again(const BlockLayout& layout, const VoxelMask& voxels,
                                const VoxelMask& changed, std::span<const std::uint32_t> slots,
                                VoxelMask& thinned) {
  const Rule rule{*this, voxels};
  Replay<Rule> replay(layout, rule, scratch_);
  for (const std::uint32_t slot : slots)
    for_each_member(changed, slot, [&](VoxelId id) {
      thinned.reset(id);
      replay.play(id, 0);
      for (Cube27 cube = cube_around(layout, voxels, id) & kCells26; cube != 0; cube &= cube - 1)
        replay.play(layout.neighbour(id, std::countr_zero(cube)), 0);
    });
  replay.run();
  for (const auto& voxel : replay.played()) {
    set_turn(voxels, voxel.id, voxel.gone);
    if (voxel.gone == kNever)
      thinned.set(voxel.id);
    else
      thinned.reset(voxel.id);
  }
}

}  // namespace ridgeway::detail
