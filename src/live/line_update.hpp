// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "block_rows.hpp"
#include "esdf/line_envelope.hpp"
#include "marked_voxels.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

/// What was written of a voxel against what was there before.
enum class Put : std::uint8_t { kSame, kRaised, kLowered };  // kRaised: or as far, but another site

/// Sweeps lines of voxels of one row of blocks again, but no more of them than what a few due
/// voxels reach. `Sweep` says what is read and written:
///   cost(voxel)                        4 d^2 that the sweep before left; 0 at obstacles
///   way(voxel)                         along the line to the voxel whose site it has; kNoWay: none
///   write(voxel, from, along, cost)    the nearest is that of `from`, `along` its way on the line;
///                                      kNoVoxel: `from` is an obstacle beside the run
///   write_none(voxel)                  nothing in reach
///
/// Each voxel of a line wins a stretch of it, in the order of the voxels (LineEnvelope). Where the
/// costs of due voxels have only risen, nothing changes but the stretches that they had won, and
/// those go to voxels between the winners before and behind them. Else all that due voxels reach is
/// swept again: an obstacle hides all that lies behind it, so each run between obstacles for
/// itself.
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
        envelope_(row.slots.size() * kBlockSide) {}

  /// `due`: places along the line, ascending; `any_lowered`: not all have only risen.
  void sweep_line(int line, const std::vector<int>& due, bool any_lowered) {
    line_ = RowLine(row_, Sweep::kAxis, line);
    if (any_lowered) {
      sweep_all_in_reach(due);
    } else {
      find_lost(due);
      for (const Stretch& lost : lost_) give_away(lost);
    }
  }

  /// Blocks in which something was written that is new.
  void name_changed(std::vector<std::uint32_t>& slots) const {
    for (std::size_t i = 0; i < is_touched_.size(); ++i)
      if (is_touched_[i]) slots.push_back(row_.slots[i]);
  }

 private:
  struct Stretch {
    int first, last;
  };

  std::uint32_t cost_at(int place) const { return sweep_.cost(line_.voxel(place)); }
  bool is_on_line(int place) const { return place >= 0 && place < line_.size(); }
  /// Obstacles are where the line ends, if those outside are.
  bool is_wall(int place) const {
    if (is_on_line(place)) return cost_at(place) == 0;
    return solid_outside_ && (place < 0 ? row_.is_begin : row_.is_end);
  }
  static constexpr int kNobody = -2;  // one before the wall before the line
  /// The place whose site a place has.
  int winner_of(int place) const {
    const int way = sweep_.way(line_.voxel(place));
    return way == kNoWay ? kNobody : place + way;
  }

  /// The stretches that due places had won, joined where they touch.
  void find_lost(const std::vector<int>& due) {
    lost_.clear();
    int place = due.front();
    while (place > 0 && winner_of(place - 1) >= due.front()) --place;
    for (auto next = due.begin(); place < line_.size() && place <= due.back() + reach_.voxels;
         ++place) {
      const int winner = winner_of(place);
      if (winner == kNobody) continue;
      while (next != due.end() && *next < winner) ++next;
      if (next == due.end()) return;
      if (*next != winner) continue;
      if (!lost_.empty() && lost_.back().last + 1 == place) {
        lost_.back().last = place;
      } else {
        lost_.push_back({place, place});
      }
    }
  }

  /// Finds who wins a stretch now: nobody before the winner before it, nor behind that behind it.
  void give_away(const Stretch& lost) {
    int low = lost.first - reach_.voxels, high = lost.last + reach_.voxels;
    if (lost.first > 0) low = std::max(low, winner_of(lost.first - 1));
    if (lost.last + 1 < line_.size())
      if (const int winner = winner_of(lost.last + 1); winner != kNobody)
        high = std::min(high, winner);
    envelope_.begin(lost.first, lost.last);
    for (int i = std::max(low, -1); i <= std::min(high, line_.size()); ++i) add_candidate(i);
    write_winners(lost.first, lost.last);
  }

  void add_candidate(int place) {
    if (!is_on_line(place)) {
      if (is_wall(place)) envelope_.add({place, 0});
    } else if (const std::uint32_t cost = cost_at(place); cost != kNoSite) {
      envelope_.add({place, cost});
    }
  }

  void sweep_all_in_reach(const std::vector<int>& due) {
    seeds_.clear();
    for (const int place : due)
      if (cost_at(place) != 0) {
        seeds_.push_back(place);
      } else {
        note(place, sweep_.write(line_.voxel(place), kNoVoxel, 0, 0));
        for (const int beside : {place - 1, place + 1})
          if (is_on_line(beside) && cost_at(beside) != 0) seeds_.push_back(beside);
      }
    for (std::size_t i = 0; i < seeds_.size();) i = sweep_run(i);
  }

  /// Sweeps the run around a seed as far as that one, and further ones near it in the run, reach.
  /// Returns the seed after these.
  std::size_t sweep_run(std::size_t seed) {
    const int from = seeds_[seed];
    int last = from, first = from, end = from + 1;
    const auto in_run = [&](int place, int seed_place) {
      return is_on_line(place) && std::abs(place - seed_place) <= 2 * reach_.voxels &&
             cost_at(place) != 0;
    };
    while (in_run(first - 1, from)) --first;
    for (++seed; in_run(end, last); ++end)
      for (; seed < seeds_.size() && seeds_[seed] <= end; ++seed) last = end;
    while (seed < seeds_.size() && seeds_[seed] <= last) ++seed;
    envelope_.begin(first, end - 1);
    if (is_wall(first - 1)) envelope_.add({first - 1, 0});
    std::uint32_t cost = cost_at(first);
    for (int i = first; i < end; ++i) {
      const std::uint32_t next = is_on_line(i + 1) ? cost_at(i + 1) : is_wall(i + 1) ? 0 : kNoSite;
      if (cost != kNoSite) envelope_.add_before({i, cost}, next);
      cost = next;
    }
    if (is_wall(end)) envelope_.add({end, 0});
    write_winners(std::max(first, from - reach_.voxels), std::min(end - 1, last + reach_.voxels));
    return seed;
  }

  /// Writes what the envelope says of the places low to high.
  void write_winners(int low, int high) {
    int next = low;  // to be written
    envelope_.for_each_stretch([&](int begin, int stretch_end, int winner) {
      const std::uint32_t across = is_on_line(winner) ? cost_at(winner) : 0;
      const VoxelId from = across == 0 ? kNoVoxel : line_.voxel(winner);
      next = std::max(begin, low);
      for (; next < stretch_end && next <= high; ++next) {
        const VoxelId id = line_.voxel(next);
        const int along = winner - next;
        const bool is_near = std::abs(along) <= reach_.voxels;
        const std::uint32_t squared = is_near ? across + squared_halves(along) : kNoSite;
        note(next, squared <= reach_.limit ? sweep_.write(id, from, along, squared)
                                           : sweep_.write_none(id));
      }
    });
    for (; next <= high; ++next) note(next, sweep_.write_none(line_.voxel(next)));
  }

  void note(int place, Put put) {
    if (put == Put::kSame) return;
    const VoxelId id = line_.voxel(place);
    changed_.voxels.set(id);
    if (put == Put::kLowered) changed_.lowered.set(id);
    is_touched_[static_cast<std::size_t>(place / kBlockSide)] = true;
  }

  const BlockRow& row_;
  const Sweep& sweep_;
  const bool solid_outside_;
  const SweepReach reach_;
  MarkedVoxels& changed_;
  RowLine line_;
  std::vector<std::uint8_t> is_touched_;  // by block of the row
  std::vector<int> seeds_;                // places around which all is swept again
  std::vector<Stretch> lost_;
  LineEnvelope envelope_;
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
      const std::uint64_t lowered = due_lines(row, due.lowered, Sweep::kAxis);
      for (std::uint64_t lines = due_lines(row, due.voxels, Sweep::kAxis); lines != 0;
           lines &= lines - 1) {
        const int line = std::countr_zero(lines);
        due_places(row, due.voxels, Sweep::kAxis, line, places);
        update.sweep_line(line, places, (lowered >> line & 1) != 0);
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
