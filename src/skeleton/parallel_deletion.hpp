// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "sub_field.hpp"

namespace ridgeway::detail {

inline constexpr std::size_t kParallelFrom = 1024;  // below this a loop is faster alone

/// One round over a work list: its voxels sub-field by sub-field, each deleted if
/// `may_go(id, cube)` says so of its neighbourhood as it is then. Inside a sub-field the order
/// does not matter, since no decision there sees another one's result. Returns the deleted ones,
/// in the order of the work list within each sub-field.
template <typename MayGo>
std::vector<VoxelId> delete_round(const BlockLayout& layout, VoxelMask& voxels,
                                  const std::vector<VoxelId>& work, const MayGo& may_go) {
  std::array<std::vector<VoxelId>, 8> fields;
  for (const VoxelId id : work)
    if (voxels.test(id)) fields[sub_field(id)].push_back(id);
  std::vector<VoxelId> deleted;
  std::vector<std::uint8_t> gone;
  for (const std::vector<VoxelId>& field : fields) {
    if (field.size() < kParallelFrom) {
      for (const VoxelId id : field)
        if (may_go(id, cube_around(layout, voxels, id))) {
          voxels.reset(id);
          deleted.push_back(id);
        }
      continue;
    }
    gone.assign(field.size(), 0);
    parallel_for_each_index(
        field.size(),
        [&](std::size_t i) {
          if (!may_go(field[i], cube_around(layout, voxels, field[i]))) return;
          gone[i] = 1;
        },
        128);
    for (std::size_t i = 0; i < field.size(); ++i)
      if (gone[i]) {
        voxels.reset(field[i]);
        deleted.push_back(field[i]);
      }
  }
  return deleted;
}

/// Members of `voxels` 26-adjacent to the given ones, each once, in no order that means
/// anything.
inline std::vector<VoxelId> neighbours_of(const BlockLayout& layout, const VoxelMask& voxels,
                                          const std::vector<VoxelId>& ids) {
  const auto for_each_neighbour = [&](VoxelId id, const auto& body) {
    for (Cube27 cube = cube_around(layout, voxels, id) & kCells26; cube != 0; cube &= cube - 1)
      body(layout.neighbour(id, std::countr_zero(cube)));
  };
  // A mask, which all threads mark, is faster than to sort, unless there are many blocks for each.
  constexpr std::size_t kBlocksEach = 16;
  if (ids.size() >= kParallelFrom && kBlocksEach * ids.size() >= layout.block_count()) {
    VoxelMask neighbours(layout);
    parallel_for_each_index(
        ids.size(),
        [&](std::size_t i) {
          for_each_neighbour(ids[i], [&](VoxelId id) {
            std::atomic_ref(neighbours.block(id / kBlockVoxels)[id / 64 % kBlockSide])
                .fetch_or(std::uint64_t{1} << id % 64, std::memory_order_relaxed);
          });
        },
        128);
    return neighbours.members(layout);
  }
  std::vector<VoxelId> result;
  for (const VoxelId id : ids)
    for_each_neighbour(id, [&](VoxelId neighbour) { result.push_back(neighbour); });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Deletes rounds of voxels until none of them may go; after the first round only neighbours of
/// deleted voxels are asked again. Calls told(round, deleted) after each, from 0 on.
template <typename MayGo, typename Told>
void delete_layers(const BlockLayout& layout, VoxelMask& voxels, std::vector<VoxelId> work,
                   const MayGo& may_go, const Told& told) {
  for (std::uint32_t round = 0; !work.empty(); ++round) {
    const std::vector<VoxelId> deleted = delete_round(layout, voxels, work, may_go);
    told(round, deleted);
    work = neighbours_of(layout, voxels, deleted);
  }
}

}  // namespace ridgeway::detail
