// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <map>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Parts of space, or of a set of voxels, that legal 26-moves connect at a radius, by flooding over
/// every move: what the passes of Basins, and the diagram, say in a few steps
/// (docs/fast-kernels.md). For tests.
struct Regions {
  std::vector<VoxelId> voxels;  ///< all of them, ascending
  std::map<VoxelId, std::uint32_t> label;
  std::vector<VoxelId> first;  ///< by label: the smallest voxel
};

inline Regions regions_at(const EsdfMap& esdf, double radius, const VoxelMask* within = nullptr) {
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  const FreeSpace space(esdf);
  const auto passable = [&](VoxelId id) {
    return id != kNoVoxel && esdf.is_open(id) && esdf.squared[id] >= threshold &&
           (within == nullptr || within->test(id));
  };
  Regions regions;
  for (VoxelId seed = 0; seed < esdf.layout.voxel_count(); ++seed) {
    if (!passable(seed)) continue;
    regions.voxels.push_back(seed);
    const auto number = static_cast<std::uint32_t>(regions.first.size());
    if (!regions.label.try_emplace(seed, number).second) continue;
    regions.first.push_back(seed);
    std::vector<VoxelId> stack{seed};
    while (!stack.empty()) {
      const VoxelId id = stack.back();
      stack.pop_back();
      for (int d = 0; d < 27; ++d) {
        const VoxelId next = esdf.layout.neighbour(id, d);
        if (d == kCentre || !passable(next) || regions.label.contains(next) ||
            !space.move_is_free(id, next, d, threshold))
          continue;
        regions.label[next] = number;
        stack.push_back(next);
      }
    }
  }
  return regions;
}

}  // namespace ridgeway::detail
