// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "redundant_voxels.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <vector>

#include "common/parallel_sort.hpp"
#include "parallel_deletion.hpp"
#include "simple_point.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

struct Neighbour {
  VoxelId id;
  int direction;
  SquaredHalves width;  // of the move over the centre
};

/// Width of the move between two neighbours of a voxel, or 0 where they are not adjacent.
SquaredHalves width_between(const RememberedSpace& space, const Neighbour& a, const Neighbour& b) {
  const VoxelIndex o = offset_of(b.direction) - offset_of(a.direction);
  if (std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) > 1) return SquaredHalves();
  return space.move_clearance(a.id, b.id, direction_of(o));
}

/// Whether each pair of neighbours is connected without the centre as widely as over it.
bool can_do_without(const RememberedSpace& space, SquaredHalves threshold, VoxelId id,
                    Cube27 cube) {
  std::array<Neighbour, 26> neighbours;
  std::size_t count = 0;
  for (Cube27 cells = cube & kCells26; cells != 0; cells &= cells - 1) {
    const int d = std::countr_zero(cells);
    const VoxelId other = space.map().layout.neighbour(id, d);
    const SquaredHalves width = space.move_clearance(id, other, d);
    if (width >= threshold) neighbours[count++] = {other, d, width};
  }
  std::sort(neighbours.begin(), neighbours.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Neighbour& a, const Neighbour& b) { return a.width > b.width; });
  // Each one, widest first, must hang on a wider one without the centre.
  for (std::size_t i = 1; i < count; ++i) {
    std::array<bool, 26> reached{};
    std::vector<std::size_t> stack{i};
    reached[i] = true;
    bool hangs = false;
    while (!stack.empty() && !hangs) {
      const std::size_t from = stack.back();
      stack.pop_back();
      for (std::size_t to = 0; to < count; ++to) {
        if (reached[to] ||
            width_between(space, neighbours[from], neighbours[to]) < neighbours[i].width)
          continue;
        reached[to] = true;
        hangs |= to < i;
        stack.push_back(to);
      }
    }
    if (!hangs) return false;
  }
  return count > 0;
}

/// Deletes voxels one after the other, the lowest first. What may go depends on what is left around
/// it alone: so all are asked at once, and in turn come only those that might go then, and those
/// beside which one has gone since.
template <typename MayGo>
class OrderedRound {
 public:
  OrderedRound(const EsdfMap& esdf, const MayGo& may_go, VoxelMask& diagram)
      : esdf_(esdf), may_go_(may_go), diagram_(diagram), work_(esdf.layout) {}

  /// The deleted ones of a list in which each is named once.
  std::vector<VoxelId> run(const std::vector<VoxelId>& work) {
    for (const VoxelId id : work) work_.set(id);
    ask_all(work);
    std::vector<VoxelId> deleted;
    for (std::size_t next = 0; next < due_.size() || !again_.empty();) {
      const bool is_due = again_.empty() || (next < due_.size() && due_[next].turn <= again_.top());
      const Due due = is_due ? due_[next++] : Due{again_.top(), kNobodys};
      while (!again_.empty() && again_.top() == due.turn) again_.pop();
      const VoxelId id = voxel_at(due.turn);
      const Cube27 cube = cube_around(esdf_.layout, diagram_, id);
      if (cube != due.cube && !may_go_(id, cube)) continue;
      diagram_.reset(id);
      deleted.push_back(id);
      ask_again_around(due.turn, id, cube);
    }
    for (const VoxelId id : work) work_.reset(id);
    return deleted;
  }

 private:
  using Turn = std::uint64_t;              // level, then place in the order of voxels
  static constexpr Cube27 kNobodys = ~0u;  // no neighbourhood
  struct Due {
    Turn turn;
    Cube27 cube;  ///< with which it may go
  };

  Turn turn_of(VoxelId id) const {
    return std::uint64_t{esdf_.squared[id]} << 32 | esdf_.layout.order_of(id);
  }
  VoxelId voxel_at(Turn turn) const {
    return esdf_.layout.voxel_at_order(static_cast<std::uint32_t>(turn));
  }

  void ask_all(const std::vector<VoxelId>& work) {
    std::vector<Cube27> with(work.size());
    parallel_for_each_index(
        work.size(),
        [&](std::size_t i) {
          const Cube27 cube = cube_around(esdf_.layout, diagram_, work[i]);
          with[i] = may_go_(work[i], cube) ? cube : kNobodys;
        },
        64);
    due_.clear();
    for (std::size_t i = 0; i < work.size(); ++i)
      if (with[i] != kNobodys) due_.push_back({turn_of(work[i]), with[i]});
    parallel_sort(due_.begin(), due_.end(),
                  [](const Due& a, const Due& b) { return a.turn < b.turn; });
  }

  void ask_again_around(Turn turn, VoxelId id, Cube27 cube) {
    for (Cube27 cells = cube & kCells26; cells != 0; cells &= cells - 1) {
      const VoxelId beside = esdf_.layout.neighbour(id, std::countr_zero(cells));
      if (const Turn later = turn_of(beside); later > turn && work_.test(beside))
        again_.push(later);
    }
  }

  const EsdfMap& esdf_;
  const MayGo& may_go_;
  VoxelMask& diagram_;
  VoxelMask work_;        // those of the round
  std::vector<Due> due_;  // that may go unless something around them goes before
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> again_;
};

}  // namespace

void remove_redundant_voxels(const RememberedSpace& space, SquaredHalves threshold,
                             const Basins& basins, VoxelMask& diagram) {
  const EsdfMap& esdf = space.map();
  const auto may_go = [&](VoxelId id, Cube27 cube) {
    return basins.next[id] != kCentre && is_simple(cube) && !is_curve_end(cube) &&
           can_do_without(space, threshold, id, cube);
  };
  OrderedRound round(esdf, may_go, diagram);
  for (std::vector<VoxelId> work = diagram.members(esdf.layout); !work.empty();)
    work = neighbours_of(esdf.layout, diagram, round.run(work));
}

}  // namespace ridgeway::detail
