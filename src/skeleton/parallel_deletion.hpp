// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <utility>
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

/// Leaves each voxel once, in ascending order.
inline void sort_out_doubles(std::vector<VoxelId>& ids) {
  tbb::parallel_sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Members of `voxels` 26-adjacent to the given ones, each once, in ascending order.
inline std::vector<VoxelId> neighbours_of(const BlockLayout& layout, const VoxelMask& voxels,
                                          const std::vector<VoxelId>& ids) {
  // Each part of the ids by itself, then what the parts have in common.
  constexpr std::size_t kPart = 4 * kParallelFrom;
  std::vector<std::vector<VoxelId>> found((ids.size() + kPart - 1) / kPart);
  parallel_for_each_index(found.size(), [&](std::size_t part) {
    const auto first = ids.begin() + static_cast<std::ptrdiff_t>(part * kPart);
    const auto last = part + 1 == found.size() ? ids.end() : first + kPart;
    std::for_each(first, last, [&](VoxelId id) {
      for (Cube27 cube = cube_around(layout, voxels, id) & kCells26; cube != 0; cube &= cube - 1)
        found[part].push_back(layout.neighbour(id, std::countr_zero(cube)));
    });
    sort_out_doubles(found[part]);
  });
  if (found.empty()) return {};
  for (std::size_t part = 1; part < found.size(); ++part)
    found[0].insert(found[0].end(), found[part].begin(), found[part].end());
  if (found.size() > 1) sort_out_doubles(found[0]);
  return std::move(found[0]);
}

/// Deletes rounds of voxels until none of them may go; after the first round only neighbours of
/// deleted voxels are asked again.
template <typename MayGo>
void delete_layers(const BlockLayout& layout, VoxelMask& voxels, std::vector<VoxelId> work,
                   const MayGo& may_go) {
  while (!work.empty())
    work = neighbours_of(layout, voxels, delete_round(layout, voxels, work, may_go));
}

}  // namespace ridgeway::detail
