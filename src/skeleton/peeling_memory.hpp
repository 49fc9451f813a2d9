// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "turn_replay.hpp"
#include "voxel/flat_table.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {

/// How a kernel was peeled: when each voxel went. After a change of the map only those are asked
/// again whose turn, or what they see at it, may be another; the result is that of peel_levels.
class PeelingMemory {
 public:
  /// Blocks may have come since; the levels of these voxels alone may be others. `slots`: the
  /// blocks that hold some of them.
  void change(const BlockLayout& layout, const VoxelMask& changed,
              std::span<const std::uint32_t> slots);

  /// As peel_levels, for the map to which it has been changed. Its levels are kept, in the same
  /// memory, which nobody may write to from then on. `rest`: voxels of which nothing is given, as
  /// they, and those beside them, are as when it was peeled last.
  const VoxelMask& peel(const EsdfMap& esdf, const VoxelMask& traversable,
                        const VoxelMask& not_simple, const VoxelMask& keep,
                        const Rest* rest = nullptr);
  /// How many voxels that left.
  std::size_t left_count() const { return left_count_; }

 private:
  /// Voxels of a mask, and of which blocks they are.
  struct Marked {
    VoxelMask voxels;
    std::vector<std::uint32_t> slots;
  };

  Marked take_over(const EsdfMap& esdf, const VoxelMask& traversable, const VoxelMask& keep,
                   const Rest* rest);
  void peel_all(const EsdfMap& esdf, const VoxelMask& not_simple);
  void peel_again(const EsdfMap& esdf, const VoxelMask& not_simple, const Marked& changed);
  void forget(VoxelId id);
  void keep_levels(const EsdfMap& esdf, const Marked& changed);

  bool knows_any_ = false;
  VoxelMask changed_;                  // since the last peel, maybe
  VoxelField<std::uint32_t> squared_;  // levels of that
  VoxelMask traversable_, keep_;       // and what was peeled
  VoxelMask left_;                     // what it left
  std::size_t left_count_ = 0;
  VoxelMask stayed_;               // those that stayed at their first turn
  FlatTable<VoxelId, Turn> late_;  // the turns at which those of them went that went
  ReplayScratch scratch_;
};

}  // namespace ridgeway::detail
