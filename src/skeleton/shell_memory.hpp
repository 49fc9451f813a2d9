// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// Sets to work with, empty before and after each use.
struct ShellScratch {
  VoxelMask due, sheet, fresh;

  explicit ShellScratch(const BlockLayout& layout) : due(layout), sheet(layout), fresh(layout) {}
};

/// What open_shells() does, of some members of the set: those of whole 26-components of what is not
/// kept. Components do not see each other, as what is kept between them stays as it is.
void open_shells_among(const EsdfMap& esdf, VoxelMask& voxels, const VoxelMask& keep,
                       const std::vector<VoxelId>& among, ShellScratch& scratch);

/// How the shells of a set were opened last. After a change of the map only components that
/// something has changed in or beside are opened again; the result is that of open_shells().
class ShellMemory {
 public:
  /// What open_shells() leaves of these voxels. Blocks may have come since the last call;
  /// `changed`: the voxels whose level may be another than it was then.
  VoxelMask open(const EsdfMap& esdf, const VoxelMask& voxels, const VoxelMask& keep,
                 const VoxelMask& changed);

 private:
  std::vector<VoxelId> touched(const BlockLayout& layout, const VoxelMask& voxels,
                               const VoxelMask& keep, const VoxelMask& changed, VoxelMask& opened,
                               VoxelMask& seen) const;

  // Of the last call, and what it left. Thin sets: as lists they take less than a bit a voxel.
  std::vector<VoxelId> voxels_, keep_, opened_;
};

}  // namespace ridgeway::detail
