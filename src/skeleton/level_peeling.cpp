// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "level_peeling.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "common/parallel_sort.hpp"
#include "level_gather.hpp"
#include "parallel_deletion.hpp"
#include "ridgeway/common/parallel.hpp"
#include "simple_point.hpp"
#include "turns.hpp"
#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

/// LevelNeighbours of the voxels that the peeling is likely to ask, gathered in parallel before: a
/// look at all levels around one voxel waits a dozen times for memory.
class KnownNeighbours {
 public:
  KnownNeighbours(const EsdfMap& esdf, const VoxelMask& traversable, const VoxelMask& not_simple)
      : esdf_(esdf),
        traversable_(traversable),
        known_(esdf.layout),
        blocks_(esdf.layout.block_count()) {
    std::vector<std::uint8_t> has_any(blocks_.size());
    not_simple.for_each_slot(
        [&](std::uint32_t slot) { has_any[slot] = !is_empty(not_simple.block(slot)); });
    parallel_for_each_index(
        blocks_.size(),
        [&](std::size_t block) {
          const auto slot = static_cast<std::uint32_t>(block);
          for (int d = 0; d < 27; ++d)
            if (const std::uint32_t n = esdf.layout.neighbour_block(slot, d);
                n != BlockLayout::kNoBlock && has_any[n] != 0)
              return gather(slot, not_simple);
        },
        64);
  }

  LevelNeighbours of(VoxelId id) const {
    if (!known_.test(id)) return neighbours_by_level(esdf_, traversable_, id);
    const std::uint32_t slot = id / kBlockVoxels;
    const std::uint32_t layer = id / 64 % kBlockSide;
    const std::uint64_t before = known_.block(slot)[layer] & ((std::uint64_t{1} << id % 64) - 1);
    const InBlock& block = blocks_[slot];
    return block.around[block.first[layer] + static_cast<std::size_t>(bit_count(before))];
  }

 private:
  /// In one block: of all voxels that are not simple at their first turn, or beside one that is.
  void gather(std::uint32_t slot, const VoxelMask& not_simple) {
    const CubeGather cubes(esdf_.layout, not_simple, slot);
    if (cubes.is_empty()) return;
    VoxelMask::Block& known = known_.block(slot);
    for_each_member(traversable_, slot, [&](VoxelId id) {
      if (cubes.cube(id) != 0) known_.set(id);
    });
    if (is_empty(known)) return;
    const Levels levels = gather_levels(esdf_, traversable_, slot);
    InBlock& block = blocks_[slot];
    std::uint16_t count = 0;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      block.first[z] = count;
      count = static_cast<std::uint16_t>(count + bit_count(known[z]));
    }
    block.around.reserve(count);
    with_lanes([&]<int lanes>(LaneCount<lanes>) {
      for_each_row_of<lanes>(known_, slot, [&](VoxelId first, unsigned members) {
        const LevelCubes<lanes> by_level(levels, bordered_place(first));
        for (; members != 0; members &= members - 1) {
          const auto x = static_cast<std::size_t>(std::countr_zero(members));
          block.around.push_back({by_level.higher[x], by_level.level[x] & kCells26});
        }
      });
    });
  }

  /// LevelNeighbours of a block's known voxels, ascending, and the first of each layer.
  struct InBlock {
    std::vector<LevelNeighbours> around;
    std::array<std::uint16_t, kBlockSide> first;
  };

  const EsdfMap& esdf_;
  const VoxelMask& traversable_;
  VoxelMask known_;
  std::vector<InBlock> blocks_;
};

/// When a voxel is asked first: by its level and sub-field, in one number.
using FirstTurn = std::uint64_t;
FirstTurn turn_of(const EsdfMap& esdf, VoxelId id) {
  return std::uint64_t{esdf.squared[id]} << 3 | sub_field(id);
}
std::uint32_t level_of(FirstTurn turn) { return static_cast<std::uint32_t>(turn >> 3); }

/// body(i) for all i below a count, by all threads where they are many.
template <typename Body>
void for_each_of_many(std::size_t count, const Body& body) {
  constexpr std::size_t kMany = 256, kGrain = 64;
  if (count >= kMany) return parallel_for_each_index(count, body, kGrain);
  for (std::size_t i = 0; i < count; ++i) body(i);
}

/// Almost all voxels go at their first turn, in which their neighbours with earlier turns are gone
/// and those with later turns still there: no look at them is needed. What is played through is
/// only the fate of those that do not go so, and of all that find one of these beside them.
///
/// Plain form: peel_in_order() in plain_peeling.hpp. From it, docs/fast-kernels.md section 4: what
/// a voxel sees at its first turn (1), which turns need not be played (2), that the others see what
/// they would (3), who is asked again (4), the order of turns (5). Voxels of one turn, none of
/// which are adjacent, are asked all at once.
class LevelPeeling {
 public:
  LevelPeeling(const EsdfMap& esdf, const VoxelMask& traversable, VoxelMask not_simple,
               const VoxelMask& keep, std::vector<LateVoxel>* late)
      : esdf_(esdf),
        keep_(keep),
        late_(late),
        around_(esdf, traversable, not_simple),
        queued_(std::move(not_simple)),
        left_(esdf.layout) {
    for (const VoxelId id : queued_.members(esdf.layout))
      first_turns_.emplace_back(turn_of(esdf, id), id);
    parallel_sort(first_turns_.begin(), first_turns_.end());
  }

  VoxelMask run() {
    while (has_turns()) {
      stop_if_cancelled();
      peel(level_of(next_turn()));
    }
    return std::move(left_);
  }

 private:
  /// A voxel that is asked, and what is found.
  struct Asked {
    VoxelId id;
    LevelNeighbours around;
    bool may_go;
  };

  bool has_turns() const { return next_ < first_turns_.size() || !more_turns_.empty(); }
  FirstTurn next_turn() const {
    if (next_ == first_turns_.size()) return more_turns_.begin()->first;
    const FirstTurn first = first_turns_[next_].first;
    return more_turns_.empty() ? first : std::min(first, more_turns_.begin()->first);
  }
  /// Those whose turn is next.
  std::vector<VoxelId> take_turn() {
    const FirstTurn turn = next_turn();
    std::vector<VoxelId> ids;
    if (!more_turns_.empty() && more_turns_.begin()->first == turn)
      ids = std::move(more_turns_.extract(more_turns_.begin()).mapped());
    for (; next_ < first_turns_.size() && first_turns_[next_].first == turn; ++next_)
      ids.push_back(first_turns_[next_].second);
    return ids;
  }

  void peel(std::uint32_t level) {
    std::vector<VoxelId> deleted;
    std::vector<Asked> stayed;
    while (has_turns() && level_of(next_turn()) == level) play(take_turn(), deleted, stayed);
    std::vector<VoxelId> work = neighbours_of(esdf_.layout, left_, deleted);
    for_each_of_many(stayed.size(), [&](std::size_t i) {  // has a neighbour gone unseen?
      stayed[i].may_go =
          (stayed[i].around.equal & ~cube_around(esdf_.layout, left_, stayed[i].id)) != 0;
    });
    for (const Asked& asked : stayed)
      if (asked.may_go) work.push_back(asked.id);
    for (std::uint32_t round = 1; !work.empty(); ++round) {
      ask_again(work, level, deleted);
      if (late_ != nullptr)
        for (const VoxelId id : deleted) late_->push_back({id, level, round});
      work = neighbours_of(esdf_.layout, left_, deleted);
    }
  }

  void play(const std::vector<VoxelId>& ids, std::vector<VoxelId>& deleted,
            std::vector<Asked>& stayed) {
    asked_.resize(ids.size());
    for_each_of_many(ids.size(), [&](std::size_t i) {
      const LevelNeighbours around = around_.of(ids[i]);
      asked_[i] = {ids[i], around, may_go(ids[i], around.later(ids[i]))};
    });
    for (const Asked& asked : asked_) {
      if (asked.may_go) {
        deleted.push_back(asked.id);
      } else {
        left_.set(asked.id);
        stayed.push_back(asked);
        queue(asked.id, asked.around.later(asked.id));
      }
    }
  }

  /// A round: sub-field by sub-field.
  void ask_again(std::vector<VoxelId>& work, std::uint32_t level, std::vector<VoxelId>& deleted) {
    parallel_sort(work.begin(), work.end(), [](VoxelId a, VoxelId b) {
      return std::pair(sub_field(a), a) < std::pair(sub_field(b), b);
    });
    work.erase(std::unique(work.begin(), work.end()), work.end());
    deleted.clear();
    std::vector<std::uint8_t> goes(work.size());
    for (std::size_t first = 0, last = 0; first < work.size(); first = last) {
      while (last < work.size() && sub_field(work[last]) == sub_field(work[first])) ++last;
      for_each_of_many(last - first, [&](std::size_t i) {
        const VoxelId id = work[first + i];
        goes[first + i] = may_go(id, above(id, level));
      });
      for (std::size_t i = first; i < last; ++i) {
        if (!goes[i]) continue;
        left_.reset(work[i]);
        deleted.push_back(work[i]);
      }
    }
  }

  /// `to_come`: the neighbours whose first turn is still to come.
  bool may_go(VoxelId id, Cube27 to_come) const {
    return !keep_.test(id) && is_simple(to_come | cube_around(esdf_.layout, left_, id));
  }

  /// Neighbours above a level that the voxel itself is not above.
  Cube27 above(VoxelId id, std::uint32_t level) const {
    Cube27 higher = around_.of(id).higher;
    if (esdf_.squared[id] == level) return higher;
    for (Cube27 cells = higher; cells != 0; cells &= cells - 1) {
      const int d = std::countr_zero(cells);
      if (esdf_.squared[esdf_.layout.neighbour(id, d)] <= level) higher &= ~(1u << d);
    }
    return higher;
  }

  void queue(VoxelId beside, Cube27 later) {
    for (Cube27 cells = later & ~cube_around(esdf_.layout, queued_, beside); cells != 0;
         cells &= cells - 1) {
      const VoxelId id = esdf_.layout.neighbour(beside, std::countr_zero(cells));
      queued_.set(id);
      more_turns_[turn_of(esdf_, id)].push_back(id);
    }
  }

  const EsdfMap& esdf_;
  const VoxelMask& keep_;
  std::vector<LateVoxel>* const late_;
  const KnownNeighbours around_;
  VoxelMask queued_;  // those whose turn is, or has been, played
  VoxelMask left_;    // those whose first turn is over and that are still there
  std::vector<std::pair<FirstTurn, VoxelId>>
      first_turns_;                                       // of those not simple at their first turn
  std::size_t next_ = 0;                                  // of these
  std::map<FirstTurn, std::vector<VoxelId>> more_turns_;  // of others
  std::vector<Asked> asked_;
};

}  // namespace

VoxelMask peel_levels(const EsdfMap& esdf, const VoxelMask& traversable, VoxelMask not_simple,
                      const VoxelMask& keep, std::vector<LateVoxel>* late) {
  return LevelPeeling(esdf, traversable, united(std::move(not_simple), keep), keep, late).run();
}

}  // namespace ridgeway::detail
