// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/parallel_sort.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {

/// Place of a voxel in the total order of heights; larger is higher. Among equally high ones the
/// earlier voxel is the higher one.
inline std::uint64_t height(const EsdfMap& esdf, VoxelId id) {
  return std::uint64_t{esdf.squared[id]} << 32 | (0xffffffffu - esdf.layout.order_of(id));
}

/// The members of a mask, the highest first.
inline std::vector<VoxelId> highest_first(const EsdfMap& esdf, const VoxelMask& voxels) {
  std::vector<VoxelId> ids = voxels.members(esdf.layout);
  std::vector<std::pair<std::uint64_t, VoxelId>> by_height;
  by_height.reserve(ids.size());
  for (const VoxelId id : ids) by_height.emplace_back(height(esdf, id), id);
  parallel_sort(by_height.begin(), by_height.end(),
                [](const auto& a, const auto& b) { return a.first > b.first; });
  std::transform(by_height.begin(), by_height.end(), ids.begin(),
                 [](const auto& voxel) { return voxel.second; });
  return ids;
}

}  // namespace ridgeway::detail
