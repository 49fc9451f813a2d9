// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "peeling_memory.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "level_peeling.hpp"
#include "simple_point.hpp"
#include "sub_field.hpp"
#include "voxel/cube_gather.hpp"

namespace ridgeway::detail {
namespace {

/// A turn in the order in which voxels are asked: level, round and sub-field in one number.
using Turn = std::uint64_t;
constexpr Turn kNever = ~Turn{0};

constexpr Turn turn_at(std::uint32_t level, std::uint32_t round, std::uint32_t field) {
  return Turn{level} << 32 | Turn{round} << 3 | field;
}
constexpr std::uint32_t level_of_turn(Turn turn) { return static_cast<std::uint32_t>(turn >> 32); }
constexpr std::uint32_t round_of_turn(Turn turn) { return static_cast<std::uint32_t>(turn) >> 3; }
/// That of another voxel in the round after.
Turn next_round(Turn turn, VoxelId id) {
  return turn_at(level_of_turn(turn), round_of_turn(turn) + 1, sub_field(id));
}

/// Voxels of a mask, and of which blocks they are.
struct Marked {
  VoxelMask voxels;
  std::vector<std::uint32_t> slots;
};

/// The members and all beside them.
Marked dilated(const BlockLayout& layout, const Marked& marked) {
  Marked result{VoxelMask(layout), {}};
  std::vector<std::uint8_t> is_named(layout.block_count());
  for (const std::uint32_t slot : marked.slots)
    for (int d = 0; d < 27; ++d) {
      const std::uint32_t n = layout.neighbour_block(slot, d);
      if (n == BlockLayout::kNoBlock || is_named[n] != 0) continue;
      is_named[n] = 1;
      result.voxels.block(n) = CubeGather(layout, marked.voxels, n).dilated();
      if (result.voxels.block(n) != VoxelMask::Block{}) result.slots.push_back(n);
    }
  return result;
}

VoxelMask::Block both(VoxelMask::Block a, const VoxelMask::Block& b) {
  for (std::size_t z = 0; z < kBlockSide; ++z) a[z] &= b[z];
  return a;
}

template <typename Body>
void for_each_of(const VoxelMask::Block& block, std::uint32_t slot, const Body& body) {
  for (std::uint32_t z = 0; z < kBlockSide; ++z)
    for (std::uint64_t bits = block[z]; bits != 0; bits &= bits - 1)
      body(slot * kBlockVoxels + z * 64 + static_cast<VoxelId>(std::countr_zero(bits)));
}

/// Plays turns again, in order, of those voxels alone that may be asked, or answer, otherwise than
/// when they were played last. Every other voxel goes at its base turn: its first one where
/// anything about it or beside it has changed, that of before elsewhere. A voxel is played from the
/// turn on at which a neighbour departs from its base turn.
class Replay {
 public:
  struct Known {  // by which voxels go that are not played
    const VoxelMask& odd;
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
    if (!known_.odd.test(id)) return first_turn(id);
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

/// Voxels beside which one that did not go at its first turn is there for longer, or less long,
/// than their base turn supposes. `fresh`: those whose base turn is to be their first one; that of
/// before has not been forgotten yet.
std::vector<VoxelId> disturbed(const BlockLayout& layout, const VoxelMask& traversable,
                               const VoxelMask& odd, const Marked& fresh, const Replay& replay) {
  std::vector<VoxelId> ids;
  const auto look_at = [&](VoxelId id) {
    const bool is_fresh = fresh.voxels.test(id);
    const Turn base = replay.base_turn(id), first = replay.first_turn(id);
    for (Cube27 cube = cube_around(layout, traversable, id) & kCells26; cube != 0;
         cube &= cube - 1) {
      const VoxelId n = layout.neighbour(id, std::countr_zero(cube));
      if (fresh.voxels.test(n) == is_fresh) continue;
      if (is_fresh ? replay.base_turn(n) > first : base > replay.first_turn(n)) ids.push_back(n);
    }
  };
  const Marked around = dilated(layout, fresh);
  for (const std::uint32_t slot : around.slots)
    for_each_of(both(odd.block(slot), around.voxels.block(slot)), slot, look_at);
  return ids;
}

}  // namespace

void PeelingMemory::change(const BlockLayout& layout, const VoxelMask& changed,
                           std::span<const std::uint32_t> slots) {
  for (VoxelMask* mask : {&changed_, &traversable_, &keep_, &left_, &odd_}) mask->grow(layout);
  for (const std::uint32_t slot : slots)
    for (std::size_t z = 0; z < kBlockSide; ++z) changed_.block(slot)[z] |= changed.block(slot)[z];
}

const VoxelMask& PeelingMemory::peel(const EsdfMap& esdf, const VoxelMask& traversable,
                                     const VoxelMask& not_simple, const VoxelMask& keep) {
  if (knows_any_)
    peel_again(esdf, traversable, not_simple, keep);
  else
    peel_all(esdf, traversable, not_simple, keep);
  knows_any_ = true;
  traversable_ = traversable;
  keep_ = keep;
  squared_ = esdf.squared.shared();
  changed_ = VoxelMask(esdf.layout);
  return left_;
}

void PeelingMemory::peel_all(const EsdfMap& esdf, const VoxelMask& traversable,
                             const VoxelMask& not_simple, const VoxelMask& keep) {
  std::vector<LateVoxel> late;
  left_ = peel_levels(esdf, traversable, not_simple, keep, &late);
  odd_ = left_;
  for (const LateVoxel& voxel : late) {
    odd_.set(voxel.id);
    late_.add(voxel.id, mixed(voxel.id), turn_at(voxel.level, voxel.round, sub_field(voxel.id)));
  }
}

void PeelingMemory::peel_again(const EsdfMap& esdf, const VoxelMask& traversable,
                               const VoxelMask& not_simple, const VoxelMask& keep) {
  const BlockLayout& layout = esdf.layout;
  Marked changed{std::move(changed_), {}};
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    VoxelMask::Block& block = changed.voxels.block(slot);
    for_each_of(VoxelMask::Block(block), slot,
                [&](VoxelId id) {  // of some only the site is another
                  if (id < squared_.size() && esdf.squared[id] == squared_[id])
                    changed.voxels.reset(id);
                });
    for (std::size_t z = 0; z < kBlockSide; ++z)
      block[z] |= (traversable.block(slot)[z] ^ traversable_.block(slot)[z]) |
                  (keep.block(slot)[z] ^ keep_.block(slot)[z]);
    if (block != VoxelMask::Block{}) changed.slots.push_back(slot);
  }
  // Those whose base turn is their first one from now on.
  const Marked fresh = dilated(layout, changed);
  Replay replay(esdf, traversable, keep, {odd_, left_, late_});
  const std::vector<VoxelId> to_play = disturbed(layout, traversable, odd_, fresh, replay);
  for (const std::uint32_t slot : fresh.slots)
    for_each_of(both(odd_.block(slot), fresh.voxels.block(slot)), slot, [&](VoxelId id) {
      odd_.reset(id);
      if (!left_.test(id)) late_.erase(id, mixed(id));
      left_.reset(id);
    });
  for (const std::uint32_t slot : fresh.slots)
    for (const VoxelMask* mask : {&not_simple, &keep})
      for_each_of(both(mask->block(slot), fresh.voxels.block(slot)), slot,
                  [&](VoxelId id) { replay.play(id, 0); });
  for (const VoxelId id : to_play) replay.play(id, 0);
  replay.run();
  for (const Replay::Played& voxel : replay.played()) {
    const VoxelId id = voxel.id;
    if (odd_.test(id) && !left_.test(id)) late_.erase(id, mixed(id));
    odd_.reset(id);
    left_.reset(id);
    if (voxel.gone == replay.first_turn(id)) continue;
    odd_.set(id);
    if (voxel.gone == kNever)
      left_.set(id);
    else
      late_.add(id, mixed(id), voxel.gone);
  }
}

}  // namespace ridgeway::detail
