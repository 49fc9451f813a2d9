// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "planar.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// First and last index on one lattice.
struct Interval {
  int first;
  int last;
};

/// How voxels of two sizes overlap along one axis; `ratio` > 1 fine voxels make one coarse one.
/// Both are counted from where their maps begin: fine voxel 0 is the lattice's voxel `origin`, and
/// coarse voxel 0 that voxel of the coarse lattice which holds its lower plane.
class Overlap {
 public:
  Overlap(double ratio, int origin)
      : ratio_(ratio),
        coarse_origin_(static_cast<int>(std::floor(on_plane(origin / ratio)))),
        begin_(on_plane(std::fma(ratio, coarse_origin_, -static_cast<double>(origin)))) {}

  /// The coarse lattice's voxel that counts as 0.
  int coarse_origin() const { return coarse_origin_; }

  /// Fine voxels that share length with a coarse one.
  Interval fine(int coarse) const {
    return {static_cast<int>(std::floor(plane(coarse))),
            static_cast<int>(std::ceil(plane(coarse + 1))) - 1};
  }
  /// Coarse voxels that share length with a fine one: one or two.
  Interval coarse(int fine_index) const {
    const int middle = static_cast<int>(std::floor((fine_index + 0.5 - begin_) / ratio_));
    return {fine(middle - 1).last >= fine_index ? middle - 1 : middle,
            fine(middle + 1).first <= fine_index ? middle + 1 : middle};
  }
  double fine_count(int coarse_index) const {
    const Interval range = fine(coarse_index);
    return range.last - range.first + 1.0;
  }

 private:
  static constexpr double kFar = 2e9;  // beyond all voxels, within int

  /// A coordinate in voxels, put onto a plane between them where it is meant to lie on it.
  static double on_plane(double at) {
    constexpr double kSlack = 1e-6;  // rounding of 1e9 voxels is less
    const double nearest = std::round(at);
    return std::abs(at - nearest) <= kSlack ? nearest : at;
  }
  /// Lower plane of a coarse voxel in fine voxels.
  double plane(int coarse) const {
    return on_plane(std::clamp(begin_ + coarse * ratio_, -kFar, kFar));
  }

  double ratio_;
  int coarse_origin_;
  double begin_;  // lower plane of coarse voxel 0 in fine voxels, from -ratio to 0
};

/// One along each axis.
struct Overlaps {
  Overlap x, y, z;

  Overlaps(double ratio, const VoxelIndex& origin)
      : x(ratio, origin.x), y(ratio, origin.y), z(ratio, origin.z) {}
};

/// A block of the coarse map and a block of the fine map that overlap.
struct BlockPair {
  BlockIndex coarse;
  std::uint32_t fine_slot;
  friend bool operator<(const BlockPair& a, const BlockPair& b) {
    return a.coarse != b.coarse ? a.coarse < b.coarse : a.fine_slot < b.fine_slot;
  }
};

std::vector<BlockPair> overlapping_blocks(const BlockLayout& fine, const Overlaps& overlaps) {
  std::vector<BlockPair> pairs;
  const auto blocks_along = [](const Overlap& overlap, int fine_block) {
    return Interval{overlap.coarse(fine_block * kBlockSide).first >> kBlockBits,
                    overlap.coarse(fine_block * kBlockSide + kBlockSide - 1).last >> kBlockBits};
  };
  for (std::uint32_t slot = 0; slot < fine.block_count(); ++slot) {
    const BlockIndex& block = fine.block(slot);
    const Interval x = blocks_along(overlaps.x, block.x), y = blocks_along(overlaps.y, block.y),
                   z = blocks_along(overlaps.z, block.z);
    for (int bz = z.first; bz <= z.last; ++bz)
      for (int by = y.first; by <= y.last; ++by)
        for (int bx = x.first; bx <= x.last; ++bx) pairs.push_back({{bx, by, bz}, slot});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// What a coarse block has met so far.
struct CoarseBlock {
  std::array<double, kBlockVoxels> free_count{};
  std::array<bool, kBlockVoxels> occupied{};
};

void accumulate(const OccupancyMap& fine, const BlockPair& pair, const Overlaps& overlaps,
                CoarseBlock& target) {
  const BlockIndex& block = fine.layout.block(pair.fine_slot);
  const VoxelState* states = fine.state.block(pair.fine_slot);
  // Per axis and fine voxel: the part of its coarse voxels that lies in the target block.
  const auto places = [](const Overlap& overlap, int fine_block, int coarse_block) {
    std::array<Interval, kBlockSide> result;
    for (int i = 0; i < kBlockSide; ++i) {
      const Interval coarse = overlap.coarse(fine_block * kBlockSide + i);
      result[static_cast<std::size_t>(i)] = {
          std::max(coarse.first - coarse_block * kBlockSide, 0),
          std::min(coarse.last - coarse_block * kBlockSide, kBlockSide - 1)};
    }
    return result;
  };
  const auto xs = places(overlaps.x, block.x, pair.coarse.x),
             ys = places(overlaps.y, block.y, pair.coarse.y),
             zs = places(overlaps.z, block.z, pair.coarse.z);
  for (std::size_t local = 0; local < kBlockVoxels; ++local) {
    if (states[local] == VoxelState::kUnknown) continue;
    const Interval px = xs[local & 7], py = ys[local >> 3 & 7], pz = zs[local >> 6];
    for (int z = pz.first; z <= pz.last; ++z)
      for (int y = py.first; y <= py.last; ++y)
        for (int x = px.first; x <= px.last; ++x) {
          const auto place = static_cast<std::size_t>(local_of({x, y, z}));
          if (states[local] == VoxelState::kOccupied)
            target.occupied[place] = true;
          else
            target.free_count[place] += 1.0;
        }
  }
}

}  // namespace

OccupancyMap resample(OccupancyMap map, double voxel_size) {
  validate_voxel_size(voxel_size, "voxel_size");
  double ratio = voxel_size / map.voxel_size;
  if (std::abs(ratio - std::round(ratio)) <= 1e-6 * ratio) ratio = std::round(ratio);
  if (ratio < 1.0) {
    std::ostringstream what;
    what << voxel_size << " m is finer than the map's own " << map.voxel_size << " m";
    throw InputError("voxel_size", what.str(), "leave it out, or give a larger one");
  }
  if (ratio == 1.0) return map;
  detail::require_three_dimensions(map);

  const Overlaps overlaps(ratio, map.origin);
  const std::vector<BlockPair> pairs = overlapping_blocks(map.layout, overlaps);
  std::vector<BlockIndex> blocks;
  for (const BlockPair& pair : pairs)
    if (blocks.empty() || blocks.back() != pair.coarse) blocks.push_back(pair.coarse);

  OccupancyMap result;
  result.voxel_size = ratio == std::round(ratio) ? ratio * map.voxel_size : voxel_size;
  result.origin = {overlaps.x.coarse_origin(), overlaps.y.coarse_origin(),
                   overlaps.z.coarse_origin()};
  result.layout = BlockLayout(std::move(blocks));
  result.state = VoxelField<VoxelState>(result.layout);
  parallel_for_each_index(result.layout.block_count(), [&](std::size_t i) {
    const auto slot = static_cast<std::uint32_t>(i);
    const BlockIndex& block = result.layout.block(slot);
    CoarseBlock met;
    for (auto pair = std::lower_bound(pairs.begin(), pairs.end(), BlockPair{block, 0});
         pair != pairs.end() && pair->coarse == block; ++pair)
      accumulate(map, *pair, overlaps, met);
    for (int local = 0; local < kBlockVoxels; ++local) {
      const VoxelIndex v = voxel_of(block, local);
      const double parts =
          overlaps.x.fine_count(v.x) * overlaps.y.fine_count(v.y) * overlaps.z.fine_count(v.z);
      const auto place = static_cast<std::size_t>(local);
      result.state.block(slot)[local] = met.occupied[place]              ? VoxelState::kOccupied
                                        : met.free_count[place] == parts ? VoxelState::kFree
                                                                         : VoxelState::kUnknown;
    }
  });
  return normalised(std::move(result));
}

}  // namespace ridgeway
