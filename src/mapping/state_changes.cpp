// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "state_changes.hpp"

#include <algorithm>
#include <bit>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

/// Marks where the robot was; the blocks around are there.
void clear_around(const Point& place, const TsdfBlocks& tsdf, const FusionConfig& config,
                  std::vector<ReportedStates::Block>& blocks) {
  for_each_in_sphere(place, config.clear_radius, config.voxel_size, [&](const VoxelIndex& v) {
    const int local = local_of(v);
    blocks[tsdf.number_of(block_of(v))].cleared[static_cast<std::size_t>(local / 64)] |=
        1ull << (local % 64);
  });
}

/// Brings what was said of a block up to date; the voxels of which it was something else.
VoxelMask::Block update(const TsdfBlock& tsdf, ReportedStates::Block& said) {
  const auto at = [](int v) { return static_cast<std::size_t>(v); };
  const VoxelMask::Block known = block_where([&](int v) { return tsdf.weight[at(v)] > 0.0f; });
  const VoxelMask::Block before = block_where([&](int v) { return tsdf.distance[at(v)] > 0.0f; });
  VoxelMask::Block changed;
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t now_known = known[z] | said.cleared[z];
    const std::uint64_t now_free = (known[z] & before[z]) | said.cleared[z];
    changed[z] = (now_known ^ said.known[z]) | (now_free ^ said.free[z]);
    said.known[z] = now_known;
    said.free[z] = now_free;
  }
  return changed;
}

}  // namespace

std::vector<VoxelChange> ReportedStates::take(TsdfBlocks& tsdf, const VoxelIndex& origin,
                                              const std::vector<Point>& all_places,
                                              const FusionConfig& config) {
  std::vector<std::uint32_t> touched = tsdf.touched();
  std::sort(touched.begin(), touched.end(),
            [&](std::uint32_t a, std::uint32_t b) { return tsdf.index(a) < tsdf.index(b); });
  std::vector<VoxelMask::Block> changed(touched.size());
  blocks.resize(tsdf.size());
  for (; places < all_places.size(); ++places)
    if (config.clear_radius > 0.0) clear_around(all_places[places], tsdf, config, blocks);
  std::vector<Block> now(touched.size());  // until nothing can fail
  parallel_for_each_index(
      touched.size(),
      [&](std::size_t i) {
        now[i] = blocks[touched[i]];
        changed[i] = update(tsdf.block(touched[i]), now[i]);
      },
      16);
  std::vector<VoxelChange> changes;
  for (std::size_t i = 0; i < touched.size(); ++i)
    for (std::size_t z = 0; z < kBlockSide; ++z)
      for (std::uint64_t bits = changed[i][z]; bits != 0; bits &= bits - 1) {
        const int place = std::countr_zero(bits);
        const VoxelIndex own = voxel_of(tsdf.index(touched[i]), static_cast<int>(64 * z) + place);
        changes.push_back({origin + own, (now[i].free[z] >> place & 1) != 0
                                             ? VoxelState::kFree
                                             : VoxelState::kOccupied});
      }
  for (std::size_t i = 0; i < touched.size(); ++i) blocks[touched[i]] = now[i];
  tsdf.forget_touched();
  return changes;
}

}  // namespace ridgeway::detail
