// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_basins.hpp"

#include <algorithm>
#include <bit>
#include <queue>
#include <utility>

#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::uint32_t kUnnumbered = 0xffffffffu;

/// Calls body(id) for the peaks of some blocks.
template <typename Body>
void for_each_peak(const LocalWays& ways, const std::vector<std::uint32_t>& slots,
                   const Body& body) {
  for (const std::uint32_t slot : slots)
    if (ways.blocks[slot].has_peak)
      for (const CriticalVoxel& voxel : ways.blocks[slot].critical)
        if (ways.next[voxel.id] == kCentre) body(voxel.id);
}

/// Takes the numbers of peaks that are none any more, and gives one to each that is new.
void number_peaks(LiveBasins& basins, const std::vector<VoxelId>& before,
                  const std::vector<std::uint32_t>& slots) {
  for (const VoxelId id : before) {
    if (basins.ways.next[id] == kCentre) continue;
    const std::uint32_t number = basins.number_of_peak.at(id, mixed(id));
    basins.number_of_peak.erase(id, mixed(id));
    basins.peaks[number] = kNoVoxel;
    basins.unused.push_back(number);
  }
  for_each_peak(basins.ways, slots, [&](VoxelId id) {
    if (basins.number_of_peak.find(id, mixed(id)) != nullptr) return;
    if (basins.unused.empty()) {
      basins.unused.push_back(static_cast<std::uint32_t>(basins.peaks.size()));
      basins.peaks.push_back(kNoVoxel);
    }
    basins.number_of_peak.add(id, mixed(id), basins.unused.back());
    basins.peaks[basins.unused.back()] = id;
    basins.unused.pop_back();
  });
}

/// Numbers blocks again whose ways changed, or lead to voxels whose number did: high ones first, as
/// ways lead up, until nothing changes. A way never comes back, so there is an end, and by then
/// each voxel has the number of the one that its way leads to.
class Renumbering {
 public:
  Renumbering(const BlockLayout& layout, const VoxelMask& traversable, LiveBasins& basins,
              BasinNumbers& numbers)
      : layout_(layout),
        traversable_(traversable),
        basins_(basins),
        numbers_(numbers),
        is_due_(layout.block_count()) {}

  /// What changed with the numbers.
  struct Changes {
    std::vector<std::uint32_t> slots;  ///< of blocks in which one became another, some maybe twice
    std::vector<std::uint32_t> left;   ///< those that these had before, some maybe twice
  };

  Changes run(const std::vector<std::uint32_t>& slots) {
    for (const std::uint32_t slot : slots) {
      basins_.exits[slot] = find_exits(slot);
      add(slot);
    }
    while (!due_.empty()) {
      const std::uint32_t slot = due_.top().second;
      due_.pop();
      is_due_[slot] = 0;
      if (!number(slot)) continue;
      changes_.slots.push_back(slot);
      for (int d = 0; d < 27; ++d)
        if (const std::uint32_t n = layout_.neighbour_block(slot, d);
            n != BlockLayout::kNoBlock && (basins_.exits[n] >> opposite(d) & 1) != 0)
          add(n);
    }
    return std::move(changes_);
  }

 private:
  void add(std::uint32_t slot) {
    if (std::exchange(is_due_[slot], std::uint8_t{1}) == 0)
      due_.emplace(basins_.ways.blocks[slot].top, slot);
  }

  Cube27 find_exits(std::uint32_t slot) const {
    const Direction* next = basins_.ways.next.block(slot);
    Cube27 exits = 0;
    for_each_member(traversable_, slot, [&](VoxelId id) {
      const VoxelId place = id % kBlockVoxels;
      if (next[place] != kCentre && !has_neighbour_in_block(place, next[place]))
        exits |= 1u << block_direction(place, next[place]);
    });
    return exits;
  }

  /// Whether any number became another.
  bool number(std::uint32_t slot) {
    std::uint32_t whole = only_basin(slot);
    BasinNumbers::InBlock several;
    if (whole == kUnnumbered) {
      several = basins_in_block(traversable_, slot, basins_.ways.next.block(slot),
                                [&](VoxelId id) { return basin_at(id); });
      if (several.basins.size() == 1) whole = several.basins[0];
      if (several.basins.size() > 1) whole = BasinNumbers::kSeveral;
    }
    if (whole != BasinNumbers::kSeveral) several = {};
    if (whole == numbers_.whole[slot] && several == numbers_.several[slot]) return false;
    for_each_basin(numbers_, slot, [&](std::uint32_t basin) { changes_.left.push_back(basin); });
    numbers_.whole[slot] = whole;
    numbers_.several[slot] = std::move(several);
    return true;
  }

  /// The one to which all ways out of a block without a peak lead, if that shows at the blocks
  /// there.
  std::uint32_t only_basin(std::uint32_t slot) const {
    if (basins_.ways.blocks[slot].has_peak) return kUnnumbered;
    std::uint32_t basin = kUnnumbered;
    for (Cube27 cells = basins_.exits[slot]; cells != 0; cells &= cells - 1) {
      const std::uint32_t there =
          numbers_.whole[layout_.neighbour_block(slot, std::countr_zero(cells))];
      if (there == BasinNumbers::kSeveral || (basin != kUnnumbered && basin != there))
        return kUnnumbered;
      basin = there;
    }
    return basin;
  }

  std::uint32_t basin_at(VoxelId id) const {
    const Direction next = basins_.ways.next[id];
    return next == kCentre ? basins_.number_of_peak.at(id, mixed(id))
                           : numbers_[layout_.neighbour(id, next)];
  }

  const BlockLayout& layout_;
  const VoxelMask& traversable_;
  LiveBasins& basins_;
  BasinNumbers& numbers_;
  std::vector<std::uint8_t> is_due_;                                  // by block
  std::priority_queue<std::pair<std::uint32_t, std::uint32_t>> due_;  // highest level, block
  Changes changes_;
};

/// Where two voxels beside each other are in different basins, saddles join these: the higher one
/// hangs together across faces, among what is higher than the lower one, with a neighbour by which
/// the lower one joins, and these voxels are joined for the same reason.
std::vector<std::pair<std::uint32_t, std::uint32_t>> joined_by(
    const BlockLayout& layout, const BasinNumbers& numbers,
    const std::vector<CriticalVoxel>& saddles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joins;
  for (const CriticalVoxel& saddle : saddles) {
    const std::uint32_t own = numbers[saddle.id];
    for (Cube27 left = saddle.higher; left != 0;) {
      const Cube27 hanging_together = flood6(left & (~left + 1), left);
      left &= ~hanging_together;
      const std::uint32_t other =
          numbers[layout.neighbour(saddle.id, std::countr_zero(hanging_together))];
      if (other != own) joins.emplace_back(std::min(own, other), std::max(own, other));
    }
  }
  std::sort(joins.begin(), joins.end());
  joins.erase(std::unique(joins.begin(), joins.end()), joins.end());
  joins.shrink_to_fit();
  return joins;
}

/// Of blocks in which ways or numbers became others, and those beside them; returns these, each
/// once.
std::vector<std::uint32_t> find_saddles_beside(const BlockLayout& layout,
                                               const BasinNumbers& numbers,
                                               const std::vector<std::uint32_t>& touched,
                                               LiveBasins& basins) {
  std::vector<std::uint8_t> is_done(layout.block_count());
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t slot : touched)
    for (int d = 0; d < 27; ++d) {
      const std::uint32_t n = layout.neighbour_block(slot, d);
      if (n == BlockLayout::kNoBlock || std::exchange(is_done[n], std::uint8_t{1}) != 0) continue;
      slots.push_back(n);
      basins.saddles[n].clear();
      for (const CriticalVoxel& voxel : basins.ways.blocks[n].critical)
        if (higher_in_others(layout, numbers, voxel) != 0) basins.saddles[n].push_back(voxel);
      basins.joins[n] = joined_by(layout, numbers, basins.saddles[n]);
    }
  return slots;
}

}  // namespace

void update_basins(LiveBasins& basins, BasinNumbers& numbers, const LiveField& field,
                   const LiveRidges& ridges) {
  const BlockLayout& layout = field.esdf.layout;
  const std::vector<std::uint32_t> slots = blocks_around(layout, field.changed);
  basins.ways.grow(layout);
  basins.exits.resize(layout.block_count());
  basins.saddles.resize(layout.block_count());
  basins.joins.resize(layout.block_count());
  numbers.whole.resize(layout.block_count(), kUnnumbered);
  numbers.several.resize(layout.block_count());
  std::vector<VoxelId> peaks;
  for_each_peak(basins.ways, slots, [&](VoxelId id) { peaks.push_back(id); });
  look_at_blocks(field.esdf, ridges.traversable, slots, basins.ways);
  number_peaks(basins, peaks, slots);
  auto [touched, left] = Renumbering(layout, ridges.traversable, basins, numbers).run(slots);
  touched.insert(touched.end(), slots.begin(), slots.end());
  update_parts(basins.parts, layout, basins.ways.blocks, numbers, basins.joins,
               find_saddles_beside(layout, numbers, touched, basins), left);
}

Watershed watershed_of(const LiveBasins& basins, BasinNumbers numbers, VoxelField<Direction> next,
                       const LiveField& field, const VoxelMask& among) {
  Watershed watershed;
  watershed.basins.next = std::move(next);
  watershed.basins.not_simple_at_first_turn =
      common_members(among, basins.ways.not_simple_at_first_turn);
  watershed.basins.basin = std::move(numbers);
  watershed.basins.peaks = basins.peaks;
  for (VoxelId& peak : watershed.basins.peaks)
    if (peak != kNoVoxel && !among.test(peak)) peak = kNoVoxel;
  for (const std::uint32_t slot : among.slots_in_order(field.esdf.layout))
    for (const CriticalVoxel& saddle : basins.saddles[slot])
      if (among.test(saddle.id)) watershed.critical.push_back(saddle);
  return watershed;
}

}  // namespace ridgeway::detail
