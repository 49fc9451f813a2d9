// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/basins.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "level_gather.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/voxel/cube_gather.hpp"
#include "ridgeway/voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

using detail::Cubes;
using detail::Floats;
using detail::LevelCubes;
using detail::load_lanes;

/// Place of a voxel in the total order of heights; larger is higher. Zero: not traversable.
std::uint64_t height(const EsdfMap& esdf, VoxelId id) {
  return std::uint64_t{esdf.squared[id]} << 32 | (0xffffffffu - id);
}

constexpr std::array<float, 27> kInverseLength = [] {
  std::array<float, 27> inverse{};
  for (std::size_t d = 0; d < 27; ++d) {
    const int squared = squared_length(static_cast<int>(d));
    inverse[d] = squared == 1 ? 1.0f : squared == 2 ? 0.70710678f : 0.57735027f;
  }
  return inverse;
}();

/// By place in a block: the directions in which a neighbour's handle is smaller. Blocks are in
/// (z, y, x) order, and so are the voxels of a block.
constexpr std::array<Cube27, kBlockVoxels> kSmallerHandles = [] {
  std::array<Cube27, kBlockVoxels> smaller{};
  for (int local = 0; local < kBlockVoxels; ++local)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex v = voxel_of({}, local), n = v + offset_of(d);
      if (block_of(n) != block_of(v) ? block_of(n) < block_of(v) : n < v)
        smaller[static_cast<std::size_t>(local)] |= 1u << d;
    }
  return smaller;
}();

/// For four voxels the directions of the steepest ways to higher neighbours, among those without a
/// dip. `first`: their levels as floats, in a gather.
Cubes steepest_ways(const float* first, const Cubes& higher) {
  const auto own = load_lanes<Floats>(first);
  Floats best = Floats{} - 1.0f;
  Cubes steepest = (higher & 0u) + kCentre;
#pragma GCC unroll 27
  for (Cube27 d = 0; d < 27; ++d) {
    const auto direction = static_cast<int>(d);
    const Floats rise = load_lanes<Floats>(first + detail::bordered_step(direction)) - own;
    const Floats slope = rise * kInverseLength[d];
    const int squared = squared_length(direction);
    // A diagonal move that rises less might dip.
    const float least = squared == 1 ? 0.0f : static_cast<float>(4 * squared);
    const auto is_better = ((higher >> d & 1u) != 0u) & (rise >= least) & (slope > best);
    best = is_better ? slope : best;
    steepest = is_better ? (steepest & 0u) + d : steepest;
  }
  return steepest;
}

/// For four voxels whether adding one, from the top down, neither starts a basin nor can join two:
/// all its higher neighbours hang together by moves across faces, and one of them is across a face.
Cubes are_regular(const Cubes& higher) {
  const Cubes faces = higher & kCells6;
  return reinterpret_cast<Cubes>((faces != 0u) &
                                 (detail::flood6(faces & -faces, higher) == higher));
}

struct Landscape {
  Basins basins;
  std::vector<VoxelId> critical;  // peaks and possible passes
};

Landscape climb(const EsdfMap& esdf, const VoxelMask& traversable) {
  Landscape land;
  land.basins.next = VoxelField<Direction>(esdf.layout, kNotTraversable);
  std::vector<std::vector<VoxelId>> critical(esdf.layout.block_count());
  parallel_for_each_index(
      esdf.layout.block_count(),
      [&](std::size_t block) {
        const auto slot = static_cast<std::uint32_t>(block);
        if (traversable.block(slot) == VoxelMask::Block{}) return;
        const detail::Levels levels = detail::gather_levels(esdf, traversable, slot);
        detail::Bordered<float> heights;
        std::copy(levels.begin(), levels.end(), heights.begin());
        detail::for_each_four(traversable, slot, [&](VoxelId first, unsigned members) {
          const LevelCubes cubes(levels, detail::bordered_place(first));
          const Cubes higher =
              cubes.higher |
              (cubes.level & load_lanes<Cubes>(&kSmallerHandles[first % kBlockVoxels]));
          const Cubes steepest = steepest_ways(&heights[detail::bordered_place(first)], higher);
          const Cubes regular = are_regular(higher);
          for (; members != 0; members &= members - 1) {
            const auto x = static_cast<VoxelId>(std::countr_zero(members));
            land.basins.next[first + x] = static_cast<Direction>(steepest[x]);
            if (!regular[x]) critical[slot].push_back(first + x);
          }
        });
      },
      16);
  for (const std::vector<VoxelId>& ids : critical)
    land.critical.insert(land.critical.end(), ids.begin(), ids.end());
  return land;
}

/// Numbers the peaks and labels every voxel with its own. Threads may walk the same way twice and
/// then write the same label.
void label_basins(const EsdfMap& esdf, const VoxelMask& traversable, Landscape& land) {
  Basins& basins = land.basins;
  constexpr std::uint32_t kNone = 0xffffffffu;
  basins.basin = VoxelField<std::uint32_t>(esdf.layout, kNone);
  for (const VoxelId id : land.critical)
    if (basins.next[id] == kCentre) {
      basins.basin[id] = static_cast<std::uint32_t>(basins.peaks.size());
      basins.peaks.push_back(id);
    }
  const auto label = [&](VoxelId id) { return std::atomic_ref<std::uint32_t>(basins.basin[id]); };
  parallel_for_each_index(
      esdf.layout.block_count(),
      [&](std::size_t slot) {
        for_each_member(traversable, static_cast<std::uint32_t>(slot), [&](VoxelId start) {
          VoxelId top = start;
          std::uint32_t basin = kNone;
          while ((basin = label(top).load(std::memory_order_relaxed)) == kNone)
            top = esdf.layout.neighbour(top, basins.next[top]);
          for (VoxelId id = start; id != top; id = esdf.layout.neighbour(id, basins.next[id]))
            label(id).store(basin, std::memory_order_relaxed);
        });
      },
      16);
}

/// Kruskal over the critical voxels from the top down. A pass that is narrower than both its ends
/// waits until the level has sunk to it.
class PassFinder {
 public:
  PassFinder(const EsdfMap& esdf, const VoxelMask& traversable, double threshold, Basins& basins)
      : esdf_(esdf),
        traversable_(traversable),
        threshold_(threshold),
        basins_(basins),
        sets_(basins.peaks.size()),
        space_(esdf) {
    basins_.dynamics.assign(basins_.peaks.size(), std::numeric_limits<double>::infinity());
    highest_.resize(basins_.peaks.size());
    std::iota(highest_.begin(), highest_.end(), 0u);
  }

  void run(std::vector<VoxelId> critical) {
    std::sort(critical.begin(), critical.end(),
              [&](VoxelId a, VoxelId b) { return height(esdf_, a) > height(esdf_, b); });
    for (const VoxelId id : critical) {
      join_waiting(static_cast<double>(esdf_.squared[id]));
      add(id);
    }
    join_waiting(0.0);
  }

 private:
  void add(VoxelId id) {
    const std::uint64_t own = height(esdf_, id);
    Cube27 higher = 0;
    for (Cube27 cube = cube_around(esdf_.layout, traversable_, id) & kCells26; cube != 0;
         cube &= cube - 1) {
      const int d = std::countr_zero(cube);
      if (height(esdf_, esdf_.layout.neighbour(id, d)) > own) higher |= 1u << d;
    }
    for (Cube27 left = higher; left != 0;) {
      const Cube27 part = flood6(left & (~left + 1), left);
      left &= ~part;
      connect(id, part);
    }
  }

  /// Joins a voxel with a face-connected part of its higher neighbours: by a face if it can, else
  /// by the widest diagonal move.
  void connect(VoxelId id, Cube27 part) {
    const double own = esdf_.squared[id];
    Pass widest;
    for (Cube27 cells = part & kCells6 ? part & kCells6 : part; cells != 0; cells &= cells - 1) {
      const int d = std::countr_zero(cells);
      const VoxelId other = esdf_.layout.neighbour(id, d);
      if (sets_.find(basins_.basin[id]) == sets_.find(basins_.basin[other])) return;
      const double level = space_.move_clearance(id, other, d);
      if (level > widest.level) widest = {level, id, other};
      if (level >= own) break;
    }
    if (widest.level >= own) {
      join(widest);
    } else if (widest.level >= threshold_) {
      waiting_.push(widest);
    }
  }

  void join_waiting(double level) {
    while (!waiting_.empty() && waiting_.top().level > level) {
      const Pass pass = waiting_.top();
      waiting_.pop();
      join(pass);
    }
  }

  void join(const Pass& pass) {
    const std::uint32_t a = sets_.find(basins_.basin[pass.from]);
    const std::uint32_t b = sets_.find(basins_.basin[pass.to]);
    if (a == b) return;
    const auto peak_height = [&](std::uint32_t set) {
      return height(esdf_, basins_.peaks[highest_[set]]);
    };
    const std::uint32_t lower = peak_height(a) < peak_height(b) ? highest_[a] : highest_[b];
    const std::uint32_t higher = lower == highest_[a] ? highest_[b] : highest_[a];
    basins_.dynamics[lower] =
        0.5 * (std::sqrt(static_cast<double>(esdf_.squared[basins_.peaks[lower]])) -
               std::sqrt(pass.level));
    highest_[sets_.join(a, b)] = higher;
    basins_.passes.push_back(pass);
  }

  const EsdfMap& esdf_;
  const VoxelMask& traversable_;
  const double threshold_;  // of the narrowest pass that counts
  Basins& basins_;
  DisjointSets sets_;
  FreeSpace space_;
  std::vector<std::uint32_t> highest_;  // by set: the basin of its highest peak
  std::priority_queue<Pass, std::vector<Pass>, NarrowerPass> waiting_;
};

}  // namespace

Basins find_basins(const EsdfMap& esdf, const VoxelMask& traversable, double radius) {
  Landscape land = climb(esdf, traversable);
  label_basins(esdf, traversable, land);
  const double threshold = squared_threshold(radius, esdf.voxel_size);
  PassFinder(esdf, traversable, threshold, land.basins).run(std::move(land.critical));
  return std::move(land.basins);
}

}  // namespace ridgeway
