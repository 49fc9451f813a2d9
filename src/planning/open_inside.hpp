// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// Directions of the neighbours across faces; in a plane there are four.
std::span<const int> faces_of(const EsdfMap& esdf);

/// What face moves over all that is not occupied join with a voxel inside the map: in the box
/// around all that is known. What is not allocated is unknown; where it takes by far most of the
/// box, it counts as beyond the map's end.
class OpenInside {
 public:
  OpenInside(const EsdfMap& esdf, VoxelId from);

  /// Whether a voxel is joined with it; false beyond the map's end.
  bool reaches(const VoxelIndex& voxel) const;

  /// The first voxel beyond the map's end that the search came to; nothing where what is occupied
  /// encloses the voxel.
  const std::optional<VoxelIndex>& way_out() const { return way_out_; }

 private:
  void reach(const VoxelIndex& voxel);
  void reach_block(const BlockIndex& block, const VoxelIndex& from);
  void cross(const BlockIndex& block);
  /// The place in `blocks_` of a block that meets the box.
  std::size_t place_of(const BlockIndex& block) const;

  const EsdfMap& esdf_;
  const VoxelRange box_;
  const BlockIndex first_, last_;  // of the blocks that meet it
  VoxelMask voxels_;
  std::vector<bool> blocks_;  // that are not allocated, by place_of; empty: they are beyond the end
  std::vector<VoxelId> queue_;
  std::vector<BlockIndex> open_blocks_;
  std::optional<VoxelIndex> way_out_;
};

}  // namespace ridgeway::detail
