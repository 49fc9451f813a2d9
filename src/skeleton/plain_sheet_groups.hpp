// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <bit>
#include <utility>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "voxel/cube_gather.hpp"

namespace ridgeway::detail {

/// What SheetGroups::nearest() gives of some voxels, by a flood of each group: the reference.
inline std::vector<VoxelId> nearest_of_groups(const EsdfMap& esdf, VoxelMask sheet) {
  std::vector<VoxelId> places;
  for (const VoxelId seed : sheet.members(esdf.layout)) {
    if (!sheet.test(seed)) continue;
    VoxelId best = seed;
    std::vector<VoxelId> stack{seed};
    sheet.reset(seed);
    while (!stack.empty()) {
      const VoxelId id = stack.back();
      stack.pop_back();
      if (std::pair(esdf.squared[id], esdf.layout.order_of(id)) <
          std::pair(esdf.squared[best], esdf.layout.order_of(best)))
        best = id;
      for (Cube27 cube = cube_around(esdf.layout, sheet, id); cube != 0; cube &= cube - 1) {
        stack.push_back(esdf.layout.neighbour(id, std::countr_zero(cube)));
        sheet.reset(stack.back());
      }
    }
    places.push_back(best);
  }
  return places;
}

}  // namespace ridgeway::detail
