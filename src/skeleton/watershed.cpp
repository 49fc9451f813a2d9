// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "watershed.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "cube_answers.hpp"
#include "level_gather.hpp"
#include "ridgeway/common/parallel.hpp"
#include "sub_field.hpp"
#include "voxel/cube_gather.hpp"

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

/// Four voxels' steepest moves of one length to a neighbour that rises at least by `least`: a
/// diagonal move to one that rises less might dip.
struct Steepest {
  Floats slope{};  // -1: there is none
  Cubes moves{};   // all that are as steep

  /// `first`: the four levels in a gather.
  template <int squared>
  static Steepest among(const float* first) {
    constexpr float kInverse = squared == 1 ? 1.0f : squared == 2 ? 0.70710678f : 0.57735027f;
    constexpr float kLeast = squared == 1 ? 1.0f : 4.0f * squared;
    const auto beside = [&](int d) { return load_lanes<Floats>(first + bordered_step(d)); };
    Floats highest{};
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d)
      if (squared_length(d) == squared) highest = beside(d) > highest ? beside(d) : highest;
    Steepest steepest;
#pragma GCC unroll 27
    for (int d = 0; d < 27; ++d)
      if (squared_length(d) == squared)
        steepest.moves |= reinterpret_cast<Cubes>(beside(d) == highest) & 1u << d;
    const Floats rise = highest - load_lanes<Floats>(first);
    steepest.slope = rise >= kLeast ? rise * kInverse : Floats{} - 1.0f;
    return steepest;
  }
};

/// For four voxels the directions of the steepest ways to higher neighbours, among those without a
/// dip; of equally steep ones the first.
Cubes steepest_ways(const float* first, const Cubes& higher) {
  const Steepest all[] = {Steepest::among<1>(first), Steepest::among<2>(first),
                          Steepest::among<3>(first)};
  Floats best{};  // level moves across a face are ways too
  for (const Steepest& s : all) best = s.slope > best ? s.slope : best;
  Cubes moves = reinterpret_cast<Cubes>(best == 0.0f) & higher & kCells6;
  for (const Steepest& s : all) moves |= reinterpret_cast<Cubes>(s.slope == best) & s.moves;
  return moves != 0u ? first_cells(moves) : (moves & 0u) + kCentre;
}

/// Where ways inside a block end, and what its voxels are to its basins.
struct BlockWays {
  std::vector<std::uint16_t> drains;  // places where ways leave the block, and its peaks
  std::vector<VoxelId> critical;      // ascending
};

/// Where each place's way ends as long as it stays in the block.
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

/// Fills in each place's number among the drains that it returns; 0, which is none, where a place
/// is not traversable.
std::vector<std::uint16_t> find_drains(const VoxelMask& traversable, std::uint32_t slot,
                                       const Direction* next, std::uint16_t* drain) {
  const std::array<std::uint16_t, kBlockVoxels> end = ends_in_block(traversable, slot, next);
  std::vector<std::uint16_t> drains{0};
  std::fill_n(drain, kBlockVoxels, std::uint16_t{0});
  for_each_member(traversable, slot, [&](VoxelId id) {
    const VoxelId place = id % kBlockVoxels;
    if (end[place] != place) return;
    drain[place] = static_cast<std::uint16_t>(drains.size());
    drains.push_back(static_cast<std::uint16_t>(place));
  });
  for (std::size_t place = 0; place < kBlockVoxels; ++place) drain[place] = drain[end[place]];
  return drains;
}

/// Numbers the peaks and finds the basin of every drain.
void number_basins(const BlockLayout& layout, const std::vector<BlockWays>& ways, Basins& basins) {
  BasinNumbers& numbers = basins.basin;
  numbers.first.assign(ways.size() + 1, 0);
  for (std::size_t slot = 0; slot < ways.size(); ++slot)
    numbers.first[slot + 1] =
        numbers.first[slot] + static_cast<std::uint32_t>(ways[slot].drains.size());
  numbers.basin.assign(numbers.first.back(), kNone);
  const auto drain_of = [&](VoxelId id) {
    return numbers.first[id / kBlockVoxels] + numbers.drain[id];
  };
  for (std::uint32_t rank = 0; rank < ways.size(); ++rank)
    for (const VoxelId id : ways[layout.slot_at(rank)].critical)
      if (basins.next[id] == kCentre) {
        numbers.basin[drain_of(id)] = static_cast<std::uint32_t>(basins.peaks.size());
        basins.peaks.push_back(id);
      }
  const auto basin_of = [&](std::uint32_t drain) {
    return std::atomic_ref<std::uint32_t>(numbers.basin[drain]);
  };
  // Threads may walk the same way twice and then write the same number.
  parallel_for_each_index(
      ways.size(),
      [&](std::size_t slot) {
        std::vector<std::uint32_t> way;
        for (std::size_t i = 1; i < ways[slot].drains.size(); ++i) {
          way.assign(1, numbers.first[slot] + static_cast<std::uint32_t>(i));
          VoxelId at = static_cast<VoxelId>(slot * kBlockVoxels) + ways[slot].drains[i];
          std::uint32_t basin = kNone;
          while ((basin = basin_of(way.back()).load(std::memory_order_relaxed)) == kNone) {
            const VoxelId to = layout.neighbour(at, basins.next[at]);
            way.push_back(drain_of(to));
            at = to / kBlockVoxels * kBlockVoxels +
                 ways[to / kBlockVoxels].drains[numbers.drain[to]];
          }
          for (const std::uint32_t drain : way)
            basin_of(drain).store(basin, std::memory_order_relaxed);
        }
      },
      16);
}

}  // namespace

Watershed find_watershed(const EsdfMap& esdf, const VoxelMask& traversable) {
  assert(traversable.is_of(esdf.layout) && esdf.squared.is_of(esdf.layout));
  Watershed watershed;
  Basins& basins = watershed.basins;
  basins.next = VoxelField<Direction>::unset(esdf.layout);
  basins.basin.drain = VoxelField<std::uint16_t>::unset(esdf.layout);
  basins.not_simple_at_first_turn = VoxelMask(esdf.layout);
  std::vector<BlockWays> ways(esdf.layout.block_count());
  CubeAnswers answers;
  parallel_for_each_index(
      esdf.layout.block_count(),
      [&](std::size_t block) {
        const auto slot = static_cast<std::uint32_t>(block);
        std::fill_n(basins.next.block(slot), kBlockVoxels, kNotTraversable);
        if (traversable.block(slot) == VoxelMask::Block{}) {
          std::fill_n(basins.basin.drain.block(slot), kBlockVoxels, std::uint16_t{0});
          ways[slot].drains = {0};
          return;
        }
        const Levels levels = gather_levels(esdf, traversable, slot);
        const Bordered<float> heights = heights_of(levels);
        for_each_four(traversable, slot, [&](VoxelId first, unsigned members) {
          const VoxelId place = first % kBlockVoxels;
          const LevelCubes cubes(levels, bordered_place(first));
          const Cubes higher = cubes.higher | (cubes.level & load_lanes<Cubes>(&kEarlier[place]));
          const Cubes later =
              cubes.higher | (cubes.level & load_lanes<Cubes>(&kLaterFields[place]));
          const Cubes steepest = steepest_ways(&heights[bordered_place(first)], higher);
          for (; members != 0; members &= members - 1) {
            const auto x = static_cast<VoxelId>(std::countr_zero(members));
            basins.next[first + x] = static_cast<Direction>(steepest[x]);
            if (!answers.of(higher[x]).is_regular) ways[slot].critical.push_back(first + x);
            if (!answers.of(later[x]).is_simple) basins.not_simple_at_first_turn.set(first + x);
          }
        });
        ways[slot].drains =
            find_drains(traversable, slot, basins.next.block(slot), basins.basin.drain.block(slot));
      },
      16);
  number_basins(esdf.layout, ways, basins);
  for (std::uint32_t rank = 0; rank < ways.size(); ++rank) {
    const std::vector<VoxelId>& critical = ways[esdf.layout.slot_at(rank)].critical;
    watershed.critical.insert(watershed.critical.end(), critical.begin(), critical.end());
  }
  return watershed;
}

}  // namespace ridgeway::detail
