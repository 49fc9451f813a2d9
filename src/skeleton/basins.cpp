// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/basins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "by_height.hpp"
#include "common/parallel_sort.hpp"
#include "common/require.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/disjoint_sets.hpp"
#include "watershed.hpp"

namespace ridgeway {
namespace {

using detail::CriticalVoxel;
using detail::height;
using detail::RememberedSpace;

/// A critical voxel that may join two basins: by these of its higher neighbours.
struct Saddle {
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
std::vector<Saddle> find_saddles(const EsdfMap& esdf, const Basins& basins,
                                 const std::vector<CriticalVoxel>& critical) {
  std::vector<Saddle> saddles(critical.size());
  parallel_for_each_index(
      critical.size(),
      [&](std::size_t i) {
        const VoxelId id = critical[i].id;
        saddles[i] = {height(esdf, id), id,
                      detail::higher_in_others(esdf.layout, basins.basin, critical[i])};
      },
      64);
  std::erase_if(saddles, [](const Saddle& s) { return s.higher == 0; });
  detail::parallel_sort(saddles.begin(), saddles.end(),
                        [](const Saddle& a, const Saddle& b) { return a.height > b.height; });
  return saddles;
}

/// Kruskal over the voxels from the top down. A pass that is narrower than both its ends
/// waits until the level has sunk to it.
///
/// Plain form: plain_watershed.hpp, Kruskal over all moves of all voxels. From it,
/// docs/fast-kernels.md section 3: basins in place of voxels (1), critical voxels alone (2), of the
/// moves to a part of their higher neighbours one (3), none to their own basin (4), dips wait (5).
class PassFinder {
 public:
  PassFinder(const RememberedSpace& space, SquaredHalves threshold, Basins& basins)
      : esdf_(space.map()),
        threshold_(threshold),
        basins_(basins),
        sets_(basins.peaks.size()),
        space_(space),
        waiting_(NarrowerPass{&esdf_.layout}) {
    basins_.dynamics.assign(basins_.peaks.size(), std::numeric_limits<double>::infinity());
    highest_.resize(basins_.peaks.size());
    std::iota(highest_.begin(), highest_.end(), 0u);
  }

  void run(const std::vector<Saddle>& saddles) {
    for (const Saddle& saddle : saddles) {
      detail::stop_if_cancelled();
      join_waiting(esdf_.squared[saddle.id]);
      for_each_part(saddle.higher, [&](Cube27 part) { connect(saddle.id, part); });
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
  const RememberedSpace& space_;
  std::vector<std::uint32_t> highest_;  // by set: the basin of its highest peak
  std::priority_queue<Pass, std::vector<Pass>, NarrowerPass> waiting_;
};

}  // namespace

Cube27 detail::higher_in_others(const BlockLayout& layout, const BasinNumbers& basin,
                                const CriticalVoxel& voxel) {
  Cube27 joining = 0;
  for_each_part(voxel.higher, [&](Cube27 part) {
    const VoxelId other = layout.neighbour(voxel.id, std::countr_zero(cells_to_join(part)));
    if (basin[voxel.id] != basin[other]) joining |= part;
  });
  return joining;
}

Basins detail::find_passes(const RememberedSpace& space, double radius, Watershed watershed) {
  const SquaredHalves threshold = least_clearance(radius, space.map().voxel_size);
  PassFinder(space, threshold, watershed.basins)
      .run(find_saddles(space.map(), watershed.basins, watershed.critical));
  return std::move(watershed.basins);
}

Basins find_basins(const EsdfMap& esdf, const VoxelMask& traversable, double radius) {
  detail::require(radius > 0.0 && std::isfinite(radius), "radius", radius,
                  "give the robot's radius in metres, above 0");
  return detail::find_passes(detail::RememberedSpace(esdf, nullptr), radius,
                             detail::find_watershed(esdf, traversable));
}

}  // namespace ridgeway
