// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "simple_point.hpp"
#include "sub_field.hpp"

namespace ridgeway::detail {

/// The neighbours of a voxel in a set whose first turn comes after its own.
inline Cube27 plain_later(const EsdfMap& esdf, const VoxelMask& voxels, VoxelId id) {
  const auto turn = [&](VoxelId v) { return std::pair(esdf.squared[v], sub_field(v)); };
  Cube27 later = 0;
  for (int d = 0; d < 27; ++d) {
    const VoxelId n = esdf.layout.neighbour(id, d);
    if (n != kNoVoxel && voxels.test(n) && turn(n) > turn(id)) later |= 1u << d;
  }
  return later;
}

/// What peel_levels leaves, every turn of every voxel played, for tests: each level's voxels are
/// asked in rounds, sub-field by sub-field, then those of this and of lower levels beside a voxel
/// that went. docs/fast-kernels.md derives level_peeling.cpp from it.
inline VoxelMask peel_in_order(const EsdfMap& esdf, const VoxelMask& traversable,
                               const VoxelMask& keep) {
  const BlockLayout& layout = esdf.layout;
  std::map<std::uint32_t, std::vector<VoxelId>> levels;
  for (VoxelId id = 0; id < layout.voxel_count(); ++id)
    if (traversable.test(id)) levels[esdf.squared[id]].push_back(id);
  VoxelMask left = traversable, due(layout);
  for (auto& [level, work] : levels) {
    for (const VoxelId id : work) due.set(id);
    while (!work.empty()) {
      std::set<VoxelId> beside;
      for (std::uint32_t field = 0; field < 8; ++field)
        for (const VoxelId id : work) {
          if (sub_field(id) != field || keep.test(id) || !is_simple(cube_around(layout, left, id)))
            continue;
          left.reset(id);
          due.reset(id);
          for (int d = 0; d < 27; ++d) beside.insert(layout.neighbour(id, d));
        }
      work.clear();
      for (const VoxelId id : beside)
        if (id != kNoVoxel && due.test(id)) work.push_back(id);
    }
  }
  return left;
}

}  // namespace ridgeway::detail
