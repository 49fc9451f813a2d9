// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "watershed.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <numeric>
#include <utility>

#include "common/parallel_sort.hpp"
#include "cube_answers.hpp"
#include "level_gather.hpp"
#include "ridgeway/common/parallel.hpp"
#include "steepest_ways.hpp"
#include "sub_field.hpp"
#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// By place in a block: the directions in which a neighbour comes earlier in the order of voxels,
/// that of their blocks and then of places in the block.
constexpr std::array<Cube27, kBlockVoxels> kEarlier = [] {
  std::array<Cube27, kBlockVoxels> earlier{};
  for (int local = 0; local < kBlockVoxels; ++local)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex v = voxel_of({}, local), n = v + offset_of(d);
      if (block_of(n) != block_of(v) ? block_of(n) < block_of(v) : n < v)
        earlier[static_cast<std::size_t>(local)] |= 1u << d;
    }
  return earlier;
}();

/// Levels as floats, above a common base where they would be rounded otherwise (beyond 2,048 voxels
/// from obstacles): only their differences count, and within a block's border those stay below
/// 2^22, as distances differ by no more than their places do. Not traversable stays zero; voxels
/// without a site are equally far above all others.
Bordered<float> heights_of(const Levels& levels) {
  constexpr std::uint32_t kExact = 1u << 24;  // whole numbers up to here are floats
  std::uint32_t any = 0;
  for (const std::uint32_t level : levels) any |= level;
  Bordered<float> heights;
  if (any < kExact) {
    std::copy(levels.begin(), levels.end(), heights.begin());
    return heights;
  }
  std::uint32_t base = kNoSite;
  for (const std::uint32_t level : levels) base = std::min(base, level - 1);  // 0 becomes largest
  std::transform(levels.begin(), levels.end(), heights.begin(), [base](std::uint32_t level) {
    return static_cast<float>(level == 0 ? 0 : level - base);
  });
  return heights;
}

/// By place in a block: the directions that lead out of it.
constexpr std::array<Cube27, kBlockVoxels> kLeaving = [] {
  std::array<Cube27, kBlockVoxels> leaving{};
  for (VoxelId place = 0; place < kBlockVoxels; ++place)
    for (int d = 0; d < 27; ++d)
      if (!has_neighbour_in_block(place, d)) leaving[place] |= 1u << d;
  return leaving;
}();

bool leaves_block(VoxelId place, Direction next) { return (kLeaving[place] >> next & 1) != 0; }

/// Finds the basins of whole blocks, those first that lie high: the ways of others lead there.
/// Whatever a thread sees of what others have found, it finds the same.
class BasinFinder {
 public:
  BasinFinder(const EsdfMap& esdf, const VoxelMask& traversable, const std::vector<BlockWays>& ways,
              Basins& basins)
      : layout_(esdf.layout), traversable_(traversable), ways_(ways), basins_(basins) {
    basins.basin.whole.assign(ways.size(), kNone);
    basins.basin.several.resize(ways.size());
  }

  void run() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t slot = 0; slot < ways_.size(); ++slot)
      if (ways_[slot].top > 0) order.push_back(slot);
    parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(ways_[b].top, a) < std::pair(ways_[a].top, b);
    });
    parallel_for_each_index(
        order.size(), [&](std::size_t i) { number(order[i]); }, 16);
  }

 private:
  /// Of a block: a basin, kSeveral, or kNone as long as it is not known.
  std::uint32_t known(std::uint32_t slot) const {
    return std::atomic_ref<std::uint32_t>(basins_.basin.whole[slot])
        .load(std::memory_order_acquire);
  }
  void set_known(std::uint32_t slot, std::uint32_t basin) {
    std::atomic_ref<std::uint32_t>(basins_.basin.whole[slot])
        .store(basin, std::memory_order_release);
  }

  void number(std::uint32_t slot) {
    const std::uint32_t only = ways_[slot].has_peak ? kNone : basin_of_all_exits(slot);
    if (only != kNone) return set_known(slot, only);
    BasinNumbers::InBlock found = basins_in_block(traversable_, slot, basins_.next.block(slot),
                                                  [&](VoxelId id) { return follow(id); });
    if (found.basins.size() == 1) return set_known(slot, found.basins[0]);
    basins_.basin.several[slot] = std::move(found);
    set_known(slot, BasinNumbers::kSeveral);
  }

  /// Of a block without a peak, the basin to which all its ways lead, if that shows at the blocks
  /// that they lead to; else kNone.
  std::uint32_t basin_of_all_exits(std::uint32_t slot) const {
    const Direction* next = basins_.next.block(slot);
    std::uint32_t basin = kNone;
    Cube27 asked = 0;
    for (std::uint32_t z = 0; z < kBlockSide; ++z)
      for (std::uint64_t bits = traversable_.block(slot)[z]; bits != 0; bits &= bits - 1) {
        const VoxelId place = z * 64 + static_cast<VoxelId>(std::countr_zero(bits));
        if (!leaves_block(place, next[place])) continue;
        const int d = block_direction(place, next[place]);
        if ((asked >> d & 1) != 0) continue;
        asked |= 1u << d;
        const std::uint32_t there = known(layout_.neighbour_block(slot, d));
        if (there == kNone || there == BasinNumbers::kSeveral) return kNone;
        if (basin != kNone && basin != there) return kNone;
        basin = there;
      }
    return basin;
  }

  /// The basin of the peak to which a voxel's way leads.
  std::uint32_t follow(VoxelId id) const {
    while (basins_.next[id] != kCentre) {
      const std::uint32_t before = id / kBlockVoxels;
      id = layout_.neighbour(id, basins_.next[id]);
      if (id / kBlockVoxels != before && known(id / kBlockVoxels) != kNone)
        return basins_.basin[id];
    }
    const auto peak = std::lower_bound(
        basins_.peaks.begin(), basins_.peaks.end(), layout_.order_of(id),
        [&](VoxelId p, std::uint32_t order) { return layout_.order_of(p) < order; });
    return static_cast<std::uint32_t>(peak - basins_.peaks.begin());
  }

  const BlockLayout& layout_;
  const VoxelMask& traversable_;
  const std::vector<BlockWays>& ways_;
  Basins& basins_;
};

}  // namespace

int block_direction(VoxelId place, Direction next) {
  const BlockIndex block = block_of(voxel_of({}, static_cast<int>(place)) + offset_of(next));
  return direction_of({block.x, block.y, block.z});
}

std::array<std::uint16_t, kBlockVoxels> ends_in_block(const VoxelMask& traversable,
                                                      std::uint32_t slot, const Direction* next) {
  std::array<std::uint16_t, kBlockVoxels> end;
  for (std::uint16_t i = 0; i < kBlockVoxels; ++i) end[i] = i;
  for_each_member(traversable, slot, [&](VoxelId id) {
    const VoxelId place = id % kBlockVoxels;
    if (has_neighbour_in_block(place, next[place]))
      end[place] = static_cast<std::uint16_t>(neighbour_in_block(place, next[place]));
  });
  for (bool again = true; again;) {  // each round doubles the steps that are known
    unsigned changed = 0;
    for (std::uint16_t& e : end) {
      const std::uint16_t further = end[e];
      changed |= e ^ further;
      e = further;
    }
    again = changed != 0;
  }
  return end;
}

void LocalWays::grow(const BlockLayout& layout) {
  next.grow(layout, kNotTraversable);
  not_simple_at_first_turn.grow(layout);
  blocks.resize(layout.block_count());
}

namespace {

void look_at_block(const EsdfMap& esdf, const VoxelMask& traversable, std::uint32_t slot,
                   CubeAnswers& answers, LocalWays& ways) {
  std::fill_n(ways.next.block(slot), kBlockVoxels, kNotTraversable);
  ways.not_simple_at_first_turn.block(slot) = {};
  BlockWays& own = ways.blocks[slot];
  own = {};
  if (is_empty(traversable.block(slot))) return;
  const Levels levels = gather_levels(esdf, traversable, slot);
  const Bordered<float> heights = heights_of(levels);
  with_lanes([&]<int lanes>(LaneCount<lanes>) {
    using Cubes = typename Row<lanes>::Cubes;
    for_each_row_of<lanes>(traversable, slot, [&](VoxelId first, unsigned members) {
      const VoxelId place = first % kBlockVoxels;
      const LevelCubes<lanes> cubes(levels, bordered_place(first));
      const Cubes higher = cubes.higher | (cubes.level & load_lanes<Cubes>(&kEarlier[place]));
      const Cubes later = cubes.higher | (cubes.level & load_lanes<Cubes>(&kLaterFields[place]));
      const Cubes steepest = steepest_ways<lanes>(&heights[bordered_place(first)], higher);
      for (; members != 0; members &= members - 1) {
        const auto x = static_cast<VoxelId>(std::countr_zero(members));
        ways.next[first + x] = static_cast<Direction>(steepest[x]);
        own.has_peak |= steepest[x] == kCentre;
        own.top = std::max(own.top, esdf.squared[first + x]);
        if (!answers.of(higher[x]).is_regular) own.critical.push_back({first + x, higher[x]});
        if (!answers.of(later[x]).is_simple) ways.not_simple_at_first_turn.set(first + x);
      }
    });
  });
}

}  // namespace

void look_at_blocks(const EsdfMap& esdf, const VoxelMask& traversable,
                    std::span<const std::uint32_t> slots, LocalWays& ways) {
  assert(traversable.is_of(esdf.layout) && esdf.squared.is_of(esdf.layout));
  CubeAnswers answers;
  parallel_for_each_index(
      slots.size(),
      [&](std::size_t i) { look_at_block(esdf, traversable, slots[i], answers, ways); }, 16);
}

Watershed watershed_of(const EsdfMap& esdf, const VoxelMask& traversable,
                       const std::vector<BlockWays>& blocks, Basins local) {
  Watershed watershed{std::move(local), {}};
  Basins& basins = watershed.basins;
  for (std::uint32_t rank = 0; rank < blocks.size(); ++rank) {
    const std::vector<CriticalVoxel>& critical = blocks[esdf.layout.slot_at(rank)].critical;
    watershed.critical.insert(watershed.critical.end(), critical.begin(), critical.end());
  }
  for (const CriticalVoxel& voxel : watershed.critical)
    if (basins.next[voxel.id] == kCentre) basins.peaks.push_back(voxel.id);
  BasinFinder(esdf, traversable, blocks, basins).run();
  return watershed;
}

Watershed find_watershed(const EsdfMap& esdf, const VoxelMask& traversable) {
  const std::uint32_t count = esdf.layout.block_count();
  LocalWays ways{VoxelField<Direction>::unset(esdf.layout), VoxelMask(esdf.layout),
                 std::vector<BlockWays>(count)};
  std::vector<std::uint32_t> slots(count);
  std::iota(slots.begin(), slots.end(), 0u);
  look_at_blocks(esdf, traversable, slots, ways);
  Basins local;
  local.next = std::move(ways.next);
  local.not_simple_at_first_turn = std::move(ways.not_simple_at_first_turn);
  return watershed_of(esdf, traversable, ways.blocks, std::move(local));
}

}  // namespace ridgeway::detail
