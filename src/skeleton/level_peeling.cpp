// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "level_peeling.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <vector>

#include "common/parallel_sort.hpp"
#include "level_gather.hpp"
#include "parallel_deletion.hpp"
#include "ridgeway/common/parallel.hpp"
#include "simple_point.hpp"
#include "turns.hpp"
#include "voxel/cube_gather.hpp"

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
    for (std::uint32_t slot = 0; slot < blocks_.size(); ++slot)
      has_any[slot] = not_simple.block(slot) != VoxelMask::Block{};
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
    if (known == VoxelMask::Block{}) return;
    const Levels levels = gather_levels(esdf_, traversable_, slot);
    InBlock& block = blocks_[slot];
    std::uint16_t count = 0;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      block.first[z] = count;
      count = static_cast<std::uint16_t>(count + bit_count(known[z]));
    }
    block.around.reserve(count);
    for_each_four(known_, slot, [&](VoxelId first, unsigned members) {
      const LevelCubes by_level(levels, bordered_place(first));
      for (; members != 0; members &= members - 1) {
        const auto x = static_cast<std::size_t>(std::countr_zero(members));
        block.around.push_back({by_level.higher[x], by_level.level[x] & kCells26});
      }
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

/// When a voxel is asked first: by its level, sub-field and handle, in one number.
std::uint64_t turn_of(const EsdfMap& esdf, VoxelId id) {
  const VoxelId rest = (id >> 1 & 3) | (id >> 4 & 3) << 2 | id >> 7 << 4;  // 29 bits
  return std::uint64_t{esdf.squared[id]} << 32 | sub_field(id) << 29 | rest;
}
std::uint32_t level_of(std::uint64_t turn) { return static_cast<std::uint32_t>(turn >> 32); }
VoxelId voxel_of_turn(std::uint64_t turn) {
  const auto place = static_cast<VoxelId>(turn);
  const VoxelId field = place >> 29;
  return (field & 1) | (place & 3) << 1 | (field >> 1 & 1) << 3 | (place >> 2 & 3) << 4 |
         (field >> 2) << 6 | (place & 0x1ffffff0u) << 3;
}

/// Almost all voxels go at their first turn, in which their neighbours with earlier turns are gone
/// and those with later turns still there: no look at them is needed. What is played through is
/// only the fate of those that do not go so, and of all that find one of these beside them.
///
/// Plain form: peel_in_order() in plain_peeling.hpp. From it, docs/fast-kernels.md section 4: what
/// a voxel sees at its first turn (1), which turns need not be played (2), that the others see what
/// they would (3), who is asked again (4), the order of turns (5).
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
    for (const VoxelId id : queued_.members(esdf.layout)) first_turns_.push_back(turn_of(esdf, id));
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
  bool has_turns() const { return next_ < first_turns_.size() || !more_turns_.empty(); }
  bool takes_more() const {
    return next_ == first_turns_.size() ||
           (!more_turns_.empty() && more_turns_.top() < first_turns_[next_]);
  }
  std::uint64_t next_turn() const { return takes_more() ? more_turns_.top() : first_turns_[next_]; }
  void end_turn() {
    if (takes_more()) {
      more_turns_.pop();
    } else {
      ++next_;
    }
  }

  void peel(std::uint32_t level) {
    std::vector<VoxelId> deleted, stayed;
    while (has_turns() && level_of(next_turn()) == level) {
      const VoxelId id = voxel_of_turn(next_turn());
      end_turn();
      const Cube27 later = around_.of(id).later(id);
      if (may_go(id, later)) {
        deleted.push_back(id);
      } else {
        left_.set(id);
        stayed.push_back(id);
        queue(id, later);
      }
    }
    std::vector<VoxelId> work = neighbours_of(esdf_.layout, left_, deleted);
    for (const VoxelId id : stayed)  // a neighbour that went unseen
      if ((around_.of(id).equal & ~cube_around(esdf_.layout, left_, id)) != 0) work.push_back(id);
    for (std::uint32_t round = 1; !work.empty(); ++round) {
      ask_again(work, level, deleted);
      if (late_ != nullptr)
        for (const VoxelId id : deleted) late_->push_back({id, level, round});
      work = neighbours_of(esdf_.layout, left_, deleted);
    }
  }

  /// A round: sub-field by sub-field.
  void ask_again(std::vector<VoxelId>& work, std::uint32_t level, std::vector<VoxelId>& deleted) {
    std::sort(work.begin(), work.end(), [](VoxelId a, VoxelId b) {
      return std::pair(sub_field(a), a) < std::pair(sub_field(b), b);
    });
    work.erase(std::unique(work.begin(), work.end()), work.end());
    deleted.clear();
    for (const VoxelId id : work) {
      if (!may_go(id, above(id, level))) continue;
      left_.reset(id);
      deleted.push_back(id);
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
      more_turns_.push(turn_of(esdf_, id));
    }
  }

  const EsdfMap& esdf_;
  const VoxelMask& keep_;
  std::vector<LateVoxel>* const late_;
  const KnownNeighbours around_;
  VoxelMask queued_;  // those whose turn is, or has been, played
  VoxelMask left_;    // those whose first turn is over and that are still there
  std::vector<std::uint64_t> first_turns_;  // ascending; of voxels not simple at their first turn
  std::size_t next_ = 0;
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> more_turns_;
};

}  // namespace

VoxelMask peel_levels(const EsdfMap& esdf, const VoxelMask& traversable, VoxelMask not_simple,
                      const VoxelMask& keep, std::vector<LateVoxel>* late) {
  for (std::uint32_t slot = 0; slot < keep.block_count(); ++slot)
    for (std::size_t z = 0; z < kBlockSide; ++z) not_simple.block(slot)[z] |= keep.block(slot)[z];
  return LevelPeeling(esdf, traversable, std::move(not_simple), keep, late).run();
}

}  // namespace ridgeway::detail
