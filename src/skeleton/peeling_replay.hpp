// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "simple_point.hpp"
#include "sub_field.hpp"
#include "voxel/flat_table.hpp"

namespace ridgeway::detail {

/// A turn in the order in which voxels are asked: level, round and sub-field in one number.
using Turn = std::uint64_t;
inline constexpr Turn kNever = ~Turn{0};

constexpr Turn turn_at(std::uint32_t level, std::uint32_t round, std::uint32_t field) {
  return Turn{level} << 32 | Turn{round} << 3 | field;
}
constexpr std::uint32_t level_of_turn(Turn turn) { return static_cast<std::uint32_t>(turn >> 32); }
constexpr std::uint32_t round_of_turn(Turn turn) { return static_cast<std::uint32_t>(turn) >> 3; }
/// That of another voxel in the round after.
inline Turn next_round(Turn turn, VoxelId id) {
  return turn_at(level_of_turn(turn), round_of_turn(turn) + 1, sub_field(id));
}

/// Plays turns again, in order, of those voxels alone that may be asked, or answer, otherwise than
/// when they were played last. Every other voxel goes at its base turn: its first one where
/// anything about it or beside it has changed, that of before elsewhere. A voxel is played from the
/// turn on at which a neighbour departs from its base turn.
class Replay {
 public:
  struct Known {  // by which voxels go that are not played: as in PeelingMemory
    const VoxelMask& stayed;
    const VoxelMask& left;
    const FlatTable<VoxelId, Turn>& late;
  };
  struct Played {
    VoxelId id;
    Turn base, gone;
    std::uint32_t around;  // place in around_, kNone before it is looked at after its first turn
  };

  Replay(const EsdfMap& esdf, const VoxelMask& traversable, const VoxelMask& keep, Known known)
      : esdf_(esdf),
        layout_(esdf.layout),
        traversable_(traversable),
        keep_(keep),
        known_(known),
        is_played_(esdf.layout),
        places_of_(esdf.layout.block_count(), kNone) {}

  /// Plays a voxel from a turn on, unless it has gone by then. Zero: from the first.
  void play(VoxelId id, Turn from) {
    if (!traversable_.test(id) || is_played_.test(id)) return;
    const Turn base = base_turn(id);
    if (base < from) return;
    is_played_.set(id);
    set_place(id, static_cast<std::uint32_t>(played_.size()));
    played_.push_back({id, base, kNever, kNone});
    tell_neighbours(id, kNever);
    if (first_turn(id) > from)
      turns_.emplace(first_turn(id), id);
    else
      wait(played_.back(), from);
  }

  void run() {
    std::pair<Turn, VoxelId> last{0, kNoVoxel};
    while (!turns_.empty()) {
      const auto next = turns_.top();
      turns_.pop();
      if (next == std::exchange(last, next)) continue;
      const std::uint32_t place = place_of(next.second);
      if (played_[place].gone == kNever) take_turn(place, next.first);
    }
  }

  Turn first_turn(VoxelId id) const { return turn_at(esdf_.squared[id], 0, sub_field(id)); }
  Turn base_turn(VoxelId id) const {
    if (!known_.stayed.test(id)) return first_turn(id);
    return known_.left.test(id) ? kNever : known_.late.at(id, mixed(id));
  }
  const std::vector<Played>& played() const { return played_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Around = std::array<Turn, 27>;  // when neighbours go; 0 where there is none

  template <typename Body>
  void for_each_neighbour(const VoxelMask& mask, VoxelId id, const Body& body) const {
    for (Cube27 cube = cube_around(layout_, mask, id) & kCells26; cube != 0; cube &= cube - 1)
      body(std::countr_zero(cube), layout_.neighbour(id, std::countr_zero(cube)));
  }

  /// kNever also of a voxel that is played and still there.
  Turn turn_of_going(VoxelId id) const {
    return is_played_.test(id) ? played_[place_of(id)].gone : base_turn(id);
  }

  std::uint32_t place_of(VoxelId id) const {
    return places_[places_of_[id / kBlockVoxels]][id % kBlockVoxels];
  }
  void set_place(VoxelId id, std::uint32_t place) {
    std::uint32_t& places = places_of_[id / kBlockVoxels];
    if (places == kNone) {
      places = static_cast<std::uint32_t>(places_.size());
      places_.emplace_back();
    }
    places_[places][id % kBlockVoxels] = place;
  }

  Around look_around(VoxelId id) const {
    Around around{};
    for_each_neighbour(traversable_, id, [&](int d, VoxelId n) {
      around[static_cast<std::size_t>(d)] = turn_of_going(n);
    });
    return around;
  }

  /// Those that are played and look around have to know when a voxel goes.
  void tell_neighbours(VoxelId id, Turn gone) {
    for_each_neighbour(is_played_, id, [&](int d, VoxelId n) {
      const Played& other = played_[place_of(n)];
      if (other.around != kNone)
        around_[other.around][static_cast<std::size_t>(opposite(d))] = gone;
      // Neighbours of one that goes are asked in the next round, if their turn has come.
      if (gone != kNever && other.gone == kNever && esdf_.squared[n] <= level_of_turn(gone))
        turns_.emplace(next_round(gone, n), n);
    });
  }

  void take_turn(std::uint32_t place, Turn turn) {
    const VoxelId id = played_[place].id;
    const Turn base = played_[place].base;
    const bool goes = may_go(played_[place], turn);
    if (goes) {
      played_[place].gone = turn;
      tell_neighbours(id, turn);
    }
    if (goes != (turn == base))  // from here on its neighbours see what they did not
      for_each_neighbour(traversable_, id, [&](int, VoxelId n) { play(n, turn); });
    if (!goes) wait(played_[place], turn);
  }

  /// Whether it is asked at a turn at all, and simple by then.
  bool may_go(const Played& voxel, Turn turn) const {
    if (keep_.test(voxel.id)) return false;
    const Around around = voxel.around == kNone ? look_around(voxel.id) : around_[voxel.around];
    bool is_asked = round_of_turn(turn) == 0;
    Cube27 there = 0;
    for (std::size_t d = 0; d < around.size(); ++d) {
      there |= static_cast<Cube27>(around[d] > turn) << d;
      is_asked |= around[d] >> 3 == (turn >> 3) - 1;
    }
    return is_asked && is_simple(there);
  }

  /// Until the next turn at which it may be asked by what is known now, or is to be gone.
  void wait(Played& voxel, Turn turn) {
    if (voxel.around == kNone) {
      voxel.around = static_cast<std::uint32_t>(around_.size());
      around_.push_back(look_around(voxel.id));
    }
    Turn next = voxel.base > turn ? voxel.base : kNever;
    for (const Turn gone : around_[voxel.around]) {
      if (gone == kNever || level_of_turn(gone) < esdf_.squared[voxel.id]) continue;
      if (const Turn asked = next_round(gone, voxel.id); asked > turn) next = std::min(next, asked);
    }
    if (next != kNever) turns_.emplace(next, voxel.id);
  }

  const EsdfMap& esdf_;
  const BlockLayout& layout_;
  const VoxelMask& traversable_;
  const VoxelMask& keep_;
  const Known known_;
  VoxelMask is_played_;
  std::vector<Played> played_;
  std::vector<Around> around_;
  // Places among those played: by block in which some are, by voxel.
  std::vector<std::uint32_t> places_of_;  // by block, kNone where none is
  std::vector<std::array<std::uint32_t, kBlockVoxels>> places_;
  std::priority_queue<std::pair<Turn, VoxelId>, std::vector<std::pair<Turn, VoxelId>>,
                      std::greater<>>
      turns_;
};

}  // namespace ridgeway::detail
