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

#include "ridgeway/voxel/voxel_mask.hpp"
#include "sub_field.hpp"

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

/// Sets that a replay works with, empty before and after it, so that its time follows the voxels
/// that it plays, and not the map.
struct ReplayScratch {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  VoxelMask is_played;
  // Places among those played: by block in which some are, kNone where none is, and there by voxel.
  std::vector<std::uint32_t> places_of;
  std::vector<std::array<std::uint32_t, kBlockVoxels>> places;

  void grow(const BlockLayout& layout) {
    is_played.grow(layout);
    places_of.resize(layout.block_count(), kNone);
  }
};

/// Plays turns again, in order, of those voxels alone that may be asked, or answer, otherwise than
/// when they were played last. Every other voxel goes at its base turn. A voxel is played from the
/// turn on at which a neighbour departs from its base turn.
///
/// A Rule says who is asked when, and may go:
///   space()               the voxels that there are at first
///   first_turn(id)        at which a voxel is asked first; its level is 1 or more
///   later_turn(id, turn)  the next one after `turn`, not the first, at which it is asked whatever
///                         its neighbours did; kNever where there is none
///   base_turn(id)         at which it goes if it is not played
///   may_go(id, cube, turn)
/// Besides, a voxel whose level has come is asked in the round after one in which a neighbour went.
template <typename Rule>
class Replay {
 public:
  struct Played {
    VoxelId id;
    Turn base, gone;
    std::uint32_t around;  // place in around_, kNone before it is looked at after its first turn
  };

  Replay(const BlockLayout& layout, const Rule& rule, ReplayScratch& scratch)
      : layout_(layout), rule_(rule), scratch_(scratch) {}
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;
  ~Replay() {
    for (const Played& voxel : played_) {
      scratch_.is_played.reset(voxel.id);
      scratch_.places_of[voxel.id / kBlockVoxels] = kNone;
    }
    decltype(scratch_.places)().swap(scratch_.places);  // which clear() would keep
  }

  /// Plays a voxel from a turn on, unless it has gone by then. Zero: from the first.
  void play(VoxelId id, Turn from) {
    if (!rule_.space().test(id) || scratch_.is_played.test(id)) return;
    const Turn base = rule_.base_turn(id);
    if (base < from) return;
    played_.push_back({id, base, kNever, kNone});
    scratch_.is_played.set(id);
    set_place(id, static_cast<std::uint32_t>(played_.size() - 1));
    tell_neighbours(id, kNever);
    if (rule_.first_turn(id) > from)
      turns_.emplace(rule_.first_turn(id), id);
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

  const std::vector<Played>& played() const { return played_; }

 private:
  static constexpr std::uint32_t kNone = ReplayScratch::kNone;
  using Around = std::array<Turn, 27>;  // when neighbours go; 0 where there is none

  template <typename Body>
  void for_each_neighbour(const VoxelMask& mask, VoxelId id, const Body& body) const {
    for (Cube27 cube = cube_around(layout_, mask, id) & kCells26; cube != 0; cube &= cube - 1)
      body(std::countr_zero(cube), layout_.neighbour(id, std::countr_zero(cube)));
  }

  /// kNever also of a voxel that is played and still there.
  Turn turn_of_going(VoxelId id) const {
    return scratch_.is_played.test(id) ? played_[place_of(id)].gone : rule_.base_turn(id);
  }

  std::uint32_t place_of(VoxelId id) const {
    return scratch_.places[scratch_.places_of[id / kBlockVoxels]][id % kBlockVoxels];
  }
  void set_place(VoxelId id, std::uint32_t place) {
    std::uint32_t& places = scratch_.places_of[id / kBlockVoxels];
    if (places == kNone) {
      places = static_cast<std::uint32_t>(scratch_.places.size());
      scratch_.places.emplace_back();
    }
    scratch_.places[places][id % kBlockVoxels] = place;
  }

  Around look_around(VoxelId id) const {
    Around around{};
    for_each_neighbour(rule_.space(), id, [&](int d, VoxelId n) {
      around[static_cast<std::size_t>(d)] = turn_of_going(n);
    });
    return around;
  }

  bool has_come(VoxelId id, Turn turn) const {
    return level_of_turn(rule_.first_turn(id)) <= level_of_turn(turn);
  }

  /// Those that are played and look around have to know when a voxel goes.
  void tell_neighbours(VoxelId id, Turn gone) {
    for_each_neighbour(scratch_.is_played, id, [&](int d, VoxelId n) {
      const Played& other = played_[place_of(n)];
      if (other.around != kNone)
        around_[other.around][static_cast<std::size_t>(opposite(d))] = gone;
      // Neighbours of one that goes are asked in the next round, if their turn has come.
      if (gone != kNever && other.gone == kNever && has_come(n, gone))
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
      for_each_neighbour(rule_.space(), id, [&](int, VoxelId n) { play(n, turn); });
    if (!goes) wait(played_[place], turn);
  }

  /// Whether it is asked at a turn at all, and goes if so.
  bool may_go(const Played& voxel, Turn turn) const {
    const Around around = voxel.around == kNone ? look_around(voxel.id) : around_[voxel.around];
    bool is_asked = round_of_turn(turn) == 0;
    Cube27 there = 0;
    for (std::size_t d = 0; d < around.size(); ++d) {
      there |= static_cast<Cube27>(around[d] > turn) << d;
      is_asked |= around[d] >> 3 == (turn >> 3) - 1;
    }
    return is_asked && rule_.may_go(voxel.id, there, turn);
  }

  /// Until the next turn at which it may be asked by what is known now, or is to be gone.
  void wait(Played& voxel, Turn turn) {
    if (voxel.around == kNone) {
      voxel.around = static_cast<std::uint32_t>(around_.size());
      around_.push_back(look_around(voxel.id));
    }
    Turn next = voxel.base > turn ? voxel.base : kNever;
    next = std::min(next, rule_.later_turn(voxel.id, turn));
    for (const Turn gone : around_[voxel.around]) {
      if (gone == kNever || !has_come(voxel.id, gone)) continue;
      if (const Turn asked = next_round(gone, voxel.id); asked > turn) next = std::min(next, asked);
    }
    if (next != kNever) turns_.emplace(next, voxel.id);
  }

  const BlockLayout& layout_;
  const Rule& rule_;
  ReplayScratch& scratch_;
  std::vector<Played> played_;
  std::vector<Around> around_;
  std::priority_queue<std::pair<Turn, VoxelId>, std::vector<std::pair<Turn, VoxelId>>,
                      std::greater<>>
      turns_;
};

}  // namespace ridgeway::detail
