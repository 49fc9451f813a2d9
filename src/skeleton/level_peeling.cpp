// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "level_peeling.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <functional>
#include <queue>
#include <vector>

#include "level_gather.hpp"
#include "parallel_deletion.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/skeleton/simple_point.hpp"

namespace ridgeway::detail {
namespace {

/// When a voxel is asked first. No two voxels with the same level and sub-field are adjacent.
struct Turn {
  std::uint32_t level;
  std::uint32_t field;
  VoxelId id;
  friend auto operator<=>(const Turn&, const Turn&) = default;
};

/// By place in a block: the directions in which a neighbour's sub-field is a later one.
constexpr std::array<Cube27, kBlockVoxels> kLaterFields = [] {
  std::array<Cube27, kBlockVoxels> later{};
  for (VoxelId place = 0; place < kBlockVoxels; ++place)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex n = voxel_of({}, static_cast<int>(place)) + offset_of(d);
      if (sub_field(static_cast<VoxelId>(local_of(n))) > sub_field(place)) later[place] |= 1u << d;
    }
  return later;
}();

/// Voxels that do not go at their first turn even if all their neighbours with earlier turns went.
VoxelMask find_obstinate(const EsdfMap& esdf, const VoxelMask& traversable, const VoxelMask& keep) {
  VoxelMask obstinate = keep;
  parallel_for_each_index(
      esdf.layout.block_count(),
      [&](std::size_t block) {
        const auto slot = static_cast<std::uint32_t>(block);
        if (traversable.block(slot) == VoxelMask::Block{}) return;
        const Levels levels = gather_levels(esdf, traversable, slot);
        for_each_four(traversable, slot, [&](VoxelId first, unsigned members) {
          const LevelCubes cubes(levels, bordered_place(first));
          const auto later_fields = load_lanes<Cubes>(&kLaterFields[first % kBlockVoxels]);
          const Cubes simple = are_simple(cubes.higher | (cubes.level & later_fields));
          for (; members != 0; members &= members - 1) {
            const auto x = static_cast<VoxelId>(std::countr_zero(members));
            if (!simple[x]) obstinate.set(first + x);
          }
        });
      },
      16);
  return obstinate;
}

/// Almost all voxels go at their first turn, in which their neighbours with earlier turns are gone
/// and those with later turns still there: no look at them is needed. What is played through is
/// only the fate of those that do not go so, and of all that find one of these beside them.
class LevelPeeling {
 public:
  LevelPeeling(const EsdfMap& esdf, const VoxelMask& traversable, const VoxelMask& keep)
      : esdf_(esdf),
        traversable_(traversable),
        keep_(keep),
        queued_(find_obstinate(esdf, traversable, keep)),
        left_(esdf.layout) {
    std::vector<Turn> turns;
    for (const VoxelId id : queued_.members()) turns.push_back(turn_of(id));
    turns_ = Queue(std::greater<>(), std::move(turns));
  }

  VoxelMask run() {
    while (!turns_.empty()) peel(turns_.top().level);
    return std::move(left_);
  }

 private:
  using Queue = std::priority_queue<Turn, std::vector<Turn>, std::greater<>>;

  Turn turn_of(VoxelId id) const { return {esdf_.squared[id], sub_field(id), id}; }

  void peel(std::uint32_t level) {
    std::vector<VoxelId> deleted, stayed;
    while (!turns_.empty() && turns_.top().level == level) {
      const Turn turn = turns_.top();
      turns_.pop();
      if (may_go(turn)) {
        deleted.push_back(turn.id);
      } else {
        left_.set(turn.id);
        stayed.push_back(turn.id);
        queue_neighbours(turn);
      }
    }
    const Turn end{level, 8, 0};
    std::vector<VoxelId> work = neighbours_of(esdf_.layout, left_, deleted);
    for (const VoxelId id : stayed)  // a neighbour that went unseen
      if ((level_cube(id, level) & ~present(id, end)) != 0) work.push_back(id);
    while (!work.empty()) {
      ask_again(work, end, deleted);
      work = neighbours_of(esdf_.layout, left_, deleted);
    }
  }

  /// A round: sub-field by sub-field.
  void ask_again(std::vector<VoxelId>& work, const Turn& end, std::vector<VoxelId>& deleted) {
    std::sort(work.begin(), work.end(), [](VoxelId a, VoxelId b) {
      return std::pair(sub_field(a), a) < std::pair(sub_field(b), b);
    });
    work.erase(std::unique(work.begin(), work.end()), work.end());
    deleted.clear();
    for (const VoxelId id : work) {
      if (!may_go({end.level, end.field, id})) continue;
      left_.reset(id);
      deleted.push_back(id);
    }
  }

  bool may_go(const Turn& now) const {
    return !keep_.test(now.id) && is_simple(present(now.id, now));
  }

  /// Neighbours that are still there at a time: those that have stayed, and those whose turn is
  /// still to come.
  Cube27 present(VoxelId id, const Turn& now) const {
    Cube27 cube = cube_around(esdf_.layout, left_, id);
    Cube27 others = cube_around(esdf_.layout, traversable_, id) & kCells26 & ~cube;
    for (; others != 0; others &= others - 1) {
      const int d = std::countr_zero(others);
      if (turn_of(esdf_.layout.neighbour(id, d)) > now) cube |= 1u << d;
    }
    return cube;
  }

  /// Traversable neighbours of a level.
  Cube27 level_cube(VoxelId id, std::uint32_t level) const {
    Cube27 cube = cube_around(esdf_.layout, traversable_, id) & kCells26;
    for (Cube27 cells = cube; cells != 0; cells &= cells - 1) {
      const int d = std::countr_zero(cells);
      if (esdf_.squared[esdf_.layout.neighbour(id, d)] != level) cube &= ~(1u << d);
    }
    return cube;
  }

  void queue_neighbours(const Turn& now) {
    Cube27 cells = cube_around(esdf_.layout, traversable_, now.id) & kCells26 &
                   ~cube_around(esdf_.layout, queued_, now.id);
    for (; cells != 0; cells &= cells - 1) {
      const Turn turn = turn_of(esdf_.layout.neighbour(now.id, std::countr_zero(cells)));
      if (turn < now) continue;
      queued_.set(turn.id);
      turns_.push(turn);
    }
  }

  const EsdfMap& esdf_;
  const VoxelMask& traversable_;
  const VoxelMask& keep_;
  VoxelMask queued_;  // those that are, or have been, in turns_
  VoxelMask left_;    // those whose first turn is over and that are still there
  Queue turns_;
};

}  // namespace

VoxelMask peel_levels(const EsdfMap& esdf, const VoxelMask& traversable, const VoxelMask& keep) {
  return LevelPeeling(esdf, traversable, keep).run();
}

}  // namespace ridgeway::detail
