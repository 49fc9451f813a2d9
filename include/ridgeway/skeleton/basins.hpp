// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// `next` of a voxel that is not traversable.
inline constexpr Direction kNotTraversable = 27;

/// A place where two basins meet: the widest move between them.
struct Pass {
  SquaredHalves clearance;  ///< of that move
  VoxelId from = kNoVoxel;  ///< the voxel of one basin
  VoxelId to = kNoVoxel;    ///< that of the other, a neighbour of it
};

/// Order of a queue whose top is the widest pass; equally wide ones in the order of their voxels.
struct NarrowerPass {
  const BlockLayout* layout;  ///< that the voxels are of; not null

  /// Whether `a` is the narrower one, so that `b` comes first.
  bool operator()(const Pass& a, const Pass& b) const {
    if (a.clearance != b.clearance) return a.clearance < b.clearance;
    return a.from != b.from ? layout->order_of(a.from) > layout->order_of(b.from)
                            : layout->order_of(a.to) > layout->order_of(b.to);
  }
};

/// The number of each traversable voxel's basin: one for all of a block, or where several meet in
/// it one for each voxel.
struct BasinNumbers {
  /// in place of the number of a block's one basin
  static constexpr std::uint32_t kSeveral = 0xfffffffeu;

  /// The basins of a block in which several meet.
  struct InBlock {
    std::vector<std::uint32_t> basins;  ///< that meet in the block
    /// Which of those, by voxel: each in 1, 2, 4, 8 or 16 bits, as many as are needed, the lower
    /// ones first.
    std::vector<std::uint8_t> place;

    /// The number of the basin at a place in the block.
    std::uint32_t at(VoxelId voxel) const {
      const std::size_t bits = place.size() * 8 / kBlockVoxels, first = voxel * bits;
      if (bits == 16)
        return basins[place[first / 8] | static_cast<std::size_t>(place[first / 8 + 1]) << 8];
      return basins[place[first / 8] >> first % 8 & ((1u << bits) - 1)];
    }

    friend bool operator==(const InBlock&, const InBlock&) = default;  ///< Equal in every field.
  };
  std::vector<std::uint32_t>
      whole;                     ///< by block; kSeveral: by voxel; any where none is traversable
  std::vector<InBlock> several;  ///< by block

  /// The number of a traversable voxel's basin.
  std::uint32_t operator[](VoxelId id) const {
    const std::uint32_t slot = id / kBlockVoxels;
    if (whole[slot] != kSeveral) return whole[slot];
    return several[slot].at(id % kBlockVoxels);
  }
};

/// The watershed of traversable space, its height the clearance. Each voxel climbs to a peak by
/// moves that are nowhere narrower than the voxel itself; the passes, widest first, are the
/// maximum spanning forest of all basins over all legal moves. Together they tell exactly at which
/// radius any two voxels part.
///
/// Heights are ordered by (clearance, earlier voxel first), so there are no ties.
struct Basins {
  VoxelField<Direction> next;    ///< towards the peak; kCentre at a peak
  BasinNumbers basin;            ///< of the voxel
  std::vector<VoxelId> peaks;    ///< by basin; kNoVoxel for a number that no basin has
  std::vector<double> dynamics;  ///< by basin: height above its pass to a higher peak, voxels
  std::vector<Pass> passes;      ///< widest first
  /// Voxels that compute_kernel cannot delete at their first turn, even if all it asks before went.
  VoxelMask not_simple_at_first_turn;
  /// Parts of traversable space that no pass joins.
  std::size_t components() const {
    const auto unused = std::count(peaks.begin(), peaks.end(), kNoVoxel);
    return peaks.size() - static_cast<std::size_t>(unused) - passes.size();
  }
};

/// `traversable`: the voxels free at `radius` (metres); only moves that are free at it count.
Basins find_basins(const EsdfMap& esdf, const VoxelMask& traversable, double radius);

}  // namespace ridgeway
