// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/basins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "voxel/disjoint_sets.hpp"
#include "watershed.hpp"

namespace ridgeway {
namespace {

/// Place of a voxel in the total order of heights; larger is higher. Zero: not traversable.
std::uint64_t height(const EsdfMap& esdf, VoxelId id) {
  return std::uint64_t{esdf.squared[id]} << 32 | (0xffffffffu - esdf.layout.order_of(id));
}

/// A critical voxel and its higher neighbours.
struct CriticalVoxel {
  std::uint64_t height;
  VoxelId id;
  Cube27 higher;
};

/// The face-connected parts of the higher neighbours, one after the other.
template <typename Body>
void for_each_part(Cube27 higher, const Body& body) {
  while (higher != 0) {
    const Cube27 part = flood6(higher & (~higher + 1), higher);
    higher &= ~part;
    body(part);
  }
}

/// By which neighbours a voxel may be joined with a part: one across a face if it can.
Cube27 cells_to_join(Cube27 part) { return part & kCells6 ? part & kCells6 : part; }

/// From the top down the critical voxels that may join two basins.
std::vector<CriticalVoxel> order_critical(const EsdfMap& esdf, const VoxelMask& traversable,
                                          const Basins& basins,
                                          const std::vector<VoxelId>& critical) {
  std::vector<CriticalVoxel> voxels(critical.size());
  parallel_for_each_index(
      critical.size(),
      [&](std::size_t i) {
        const VoxelId id = critical[i];
        voxels[i] = {height(esdf, id), id, 0};
        Cube27 higher = 0;
        for (Cube27 cube = cube_around(esdf.layout, traversable, id) & kCells26; cube != 0;
             cube &= cube - 1) {
          const int d = std::countr_zero(cube);
          if (height(esdf, esdf.layout.neighbour(id, d)) > voxels[i].height) higher |= 1u << d;
        }
        for_each_part(higher, [&](Cube27 part) {
          const VoxelId other = esdf.layout.neighbour(id, std::countr_zero(cells_to_join(part)));
          if (basins.basin[id] != basins.basin[other]) voxels[i].higher |= part;
        });
      },
      64);
  std::erase_if(voxels, [](const CriticalVoxel& v) { return v.higher == 0; });
  std::sort(voxels.begin(), voxels.end(),
            [](const CriticalVoxel& a, const CriticalVoxel& b) { return a.height > b.height; });
  return voxels;
}

/// Kruskal over the voxels from the top down. A pass that is narrower than both its ends
/// waits until the level has sunk to it.
///
/// Plain form: plain_watershed.hpp, Kruskal over all moves of all voxels. From it,
/// docs/fast-kernels.md section 3: basins in place of voxels (1), critical voxels alone (2), of the
/// moves to a part of their higher neighbours one (3), none to their own basin (4), dips wait (5).
class PassFinder {
 public:
  PassFinder(const EsdfMap& esdf, SquaredHalves threshold, Basins& basins)
      : esdf_(esdf),
        threshold_(threshold),
        basins_(basins),
        sets_(basins.peaks.size()),
        space_(esdf),
        waiting_(NarrowerPass{&esdf.layout}) {
    basins_.dynamics.assign(basins_.peaks.size(), std::numeric_limits<double>::infinity());
    highest_.resize(basins_.peaks.size());
    std::iota(highest_.begin(), highest_.end(), 0u);
  }

  void run(const std::vector<CriticalVoxel>& voxels) {
    for (const CriticalVoxel& voxel : voxels) {
      join_waiting(esdf_.squared[voxel.id]);
      for_each_part(voxel.higher, [&](Cube27 part) { connect(voxel.id, part); });
    }
    join_waiting(SquaredHalves());
  }

 private:
  /// Joins a voxel with a face-connected part of its higher neighbours: by a face if it can, else
  /// by the widest diagonal move.
  void connect(VoxelId id, Cube27 part) {
    const SquaredHalves own = esdf_.squared[id];
    Pass widest;
    for (Cube27 cells = cells_to_join(part); cells != 0; cells &= cells - 1) {
      const int d = std::countr_zero(cells);
      const VoxelId other = esdf_.layout.neighbour(id, d);
      if (sets_.find(basins_.basin[id]) == sets_.find(basins_.basin[other])) return;
      const SquaredHalves clearance = space_.move_clearance(id, other, d);
      if (clearance > widest.clearance) widest = {clearance, id, other};
      if (clearance >= own) break;
    }
    if (widest.clearance >= own) {
      join(widest);
    } else if (widest.clearance >= threshold_) {
      waiting_.push(widest);
    }
  }

  void join_waiting(SquaredHalves level) {
    while (!waiting_.empty() && waiting_.top().clearance > level) {
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
               std::sqrt(pass.clearance.value));
    highest_[sets_.join(a, b)] = higher;
    basins_.passes.push_back(pass);
  }

  const EsdfMap& esdf_;
  const SquaredHalves threshold_;  // of the narrowest pass that counts
  Basins& basins_;
  DisjointSets sets_;
  FreeSpace space_;
  std::vector<std::uint32_t> highest_;  // by set: the basin of its highest peak
  std::priority_queue<Pass, std::vector<Pass>, NarrowerPass> waiting_;
};

}  // namespace

Basins detail::find_passes(const EsdfMap& esdf, const VoxelMask& traversable, double radius,
                           Watershed watershed) {
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  PassFinder(esdf, threshold, watershed.basins)
      .run(order_critical(esdf, traversable, watershed.basins, watershed.critical));
  return std::move(watershed.basins);
}

Basins find_basins(const EsdfMap& esdf, const VoxelMask& traversable, double radius) {
  return detail::find_passes(esdf, traversable, radius, detail::find_watershed(esdf, traversable));
}

}  // namespace ridgeway
