// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "block_rows.hpp"
#include "esdf/line_envelope.hpp"
#include "marked_voxels.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

/// Sweeps lines of voxels of one row of blocks again, but no more of them than what a few due
/// voxels reach. `Sweep` says what is read and written:
///   cost(voxel)                        4 d^2 that the sweep before left; 0 at obstacles
///   write(voxel, from, along, cost)    the nearest is that of `from`, `along` its way on the line;
///                                      kNoVoxel: `from` is an obstacle beside the run
///   write_none(voxel)                  nothing in reach
/// Both tell whether that is something else than was written there before.
///
/// An obstacle hides all that lies behind it, so each run between obstacles is for itself; in a
/// run, a voxel matters no farther than `reach`.
template <typename Sweep>
class RowUpdate {
 public:
  RowUpdate(const BlockRow& row, const Sweep& sweep, bool solid_outside, const SweepReach& reach,
            MarkedVoxels& changed)
      : row_(row),
        sweep_(sweep),
        solid_outside_(solid_outside),
        reach_(reach),
        changed_(changed),
        is_touched_(row.slots.size()),
        cost_(row.slots.size() * kBlockSide),
        envelope_(row.slots.size() * kBlockSide) {}

  /// `due`: places along the line, ascending.
  void sweep_line(int line, const std::vector<int>& due) {
    line_ = RowLine(row_, Sweep::kAxis, line);
    seeds_.clear();
    for (const int place : due)
      if (cost_at(place) != 0) {
        seeds_.push_back(place);
      } else {
        note(place, sweep_.write(line_.voxel(place), kNoVoxel, 0, 0));
        if (place > 0 && cost_at(place - 1) != 0) seeds_.push_back(place - 1);
        if (place + 1 < line_.size() && cost_at(place + 1) != 0) seeds_.push_back(place + 1);
      }
    for (std::size_t i = 0; i < seeds_.size();) i = sweep_run(i);
  }

  /// Blocks in which something was written that is new.
  void name_changed(std::vector<std::uint32_t>& slots) const {
    for (std::size_t i = 0; i < is_touched_.size(); ++i)
      if (is_touched_[i]) slots.push_back(row_.slots[i]);
  }

 private:
  std::uint32_t cost_at(int place) const { return sweep_.cost(line_.voxel(place)); }

  /// Sweeps the run around a seed as far as that one, and further ones near it in the run, reach.
  /// Returns the seed after these.
  std::size_t sweep_run(std::size_t seed) {
    const int from = seeds_[seed];
    int last = from, first = from, end = from + 1;
    const auto in_run = [&](int place, int seed_place) {
      return place >= 0 && place < line_.size() &&
             std::abs(place - seed_place) <= 2 * reach_.voxels && load(place) != 0;
    };
    load(from);
    while (in_run(first - 1, from)) --first;
    for (++seed; in_run(end, last); ++end)
      for (; seed < seeds_.size() && seeds_[seed] <= end; ++seed) last = end;
    find_winners(first, end);
    write_winners(std::max(first, from - reach_.voxels), std::min(end - 1, last + reach_.voxels));
    return seed;
  }

  std::uint32_t load(int place) { return cost_[static_cast<std::size_t>(place)] = cost_at(place); }

  void find_winners(int first, int end) {
    const auto cost = [&](int place) { return cost_[static_cast<std::size_t>(place)]; };
    const bool wall_before = first > 0 ? cost_at(first - 1) == 0 : row_.is_begin && solid_outside_;
    const bool wall_after = end < line_.size() ? cost_at(end) == 0 : row_.is_end && solid_outside_;
    envelope_.begin(first, end - 1);
    if (wall_before) envelope_.add({first - 1, 0});
    for (int i = first; i < end; ++i)
      if (cost(i) != kNoSite)
        envelope_.add_before({i, cost(i)}, i + 1 < end ? cost(i + 1) : wall_after ? 0 : kNoSite);
    if (wall_after) envelope_.add({end, 0});
    first_ = first;
    end_ = end;
  }

  void write_winners(int low, int high) {
    int next = low;  // to be written
    envelope_.for_each_stretch([&](int begin, int stretch_end, int winner) {
      const bool is_inside = winner >= first_ && winner < end_;
      const VoxelId from = is_inside ? line_.voxel(winner) : kNoVoxel;
      const std::uint32_t across = is_inside ? cost_[static_cast<std::size_t>(winner)] : 0;
      next = std::max(begin, low);
      for (; next < stretch_end && next <= high; ++next) {
        const VoxelId id = line_.voxel(next);
        const int along = winner - next;
        const bool is_near = std::abs(along) <= reach_.voxels;
        const std::uint32_t squared = is_near ? across + quarter_squared(along) : kNoSite;
        note(next, squared <= reach_.limit ? sweep_.write(id, from, along, squared)
                                           : sweep_.write_none(id));
      }
    });
    for (; next <= high; ++next) note(next, sweep_.write_none(line_.voxel(next)));
  }

  void note(int place, bool is_new) {
    if (!is_new) return;
    changed_.voxels.set(line_.voxel(place));
    is_touched_[static_cast<std::size_t>(place / kBlockSide)] = true;
  }

  const BlockRow& row_;
  const Sweep& sweep_;
  const bool solid_outside_;
  const SweepReach reach_;
  MarkedVoxels& changed_;
  RowLine line_;
  std::vector<std::uint8_t> is_touched_;  // by block of the row
  std::vector<std::uint32_t> cost_;       // by place on the line
  std::vector<int> seeds_;
  LineEnvelope envelope_;
  int first_ = 0, end_ = 0;  // of the run
};

/// One sweep, along Sweep::kAxis, of all that voxels which are due may have changed; marks what it
/// did change. In parallel, each row of blocks by one thread.
template <typename Sweep>
void sweep_again(const BlockLayout& layout, const Sweep& sweep, bool solid_outside,
                 const SweepReach& reach, const MarkedVoxels& due, MarkedVoxels& changed) {
  const std::vector<std::vector<std::uint32_t>> lanes = by_lane(layout, due.slots, Sweep::kAxis);
  std::vector<std::vector<std::uint32_t>> named(lanes.size());
  parallel_for_each_index(lanes.size(), [&](std::size_t i) {
    for_each_row_around(layout, lanes[i], Sweep::kAxis, 2 * reach.voxels, [&](const BlockRow& row) {
      RowUpdate<Sweep> update(row, sweep, solid_outside, reach, changed);
      std::vector<int> places;
      for (int line = 0; line < kBlockSide * kBlockSide; ++line) {
        due_places(row, due.voxels, Sweep::kAxis, line, places);
        if (!places.empty()) update.sweep_line(line, places);
      }
      update.name_changed(named[i]);
    });
  });
  std::vector<std::uint32_t> all;
  for (const std::vector<std::uint32_t>& some : named)
    all.insert(all.end(), some.begin(), some.end());
  changed.name(all);
}

}  // namespace ridgeway::detail
