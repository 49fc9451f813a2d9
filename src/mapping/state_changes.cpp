// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "state_changes.hpp"

#include <algorithm>
#include <bit>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

/// Marks where the robot was, in the blocks that are looked at.
void clear_around(const Point& place, const TsdfBlocks& tsdf, const FusionConfig& config,
                  AcceptedStates& states) {
  for_each_in_sphere(place, config.clear_radius, config.voxel_size, [&](const VoxelIndex& v) {
    const auto found = std::lower_bound(
        states.found.begin(), states.found.end(), block_of(v),
        [&](std::uint32_t number, const BlockIndex& b) { return tsdf.index(number) < b; });
    if (found == states.found.end() || tsdf.index(*found) != block_of(v)) return;
    const int local = local_of(v);
    states.now[static_cast<std::size_t>(found - states.found.begin())]
        .cleared[static_cast<std::size_t>(local / 64)] |= 1ull << (local % 64);
  });
}

/// Brings what was said of a block up to date; the voxels of which it was something else.
VoxelMask::Block restate(const TsdfBlock& tsdf, AcceptedStates::Block& said) {
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

std::vector<VoxelChange> AcceptedStates::find(const TsdfBlocks& tsdf, const VoxelIndex& origin,
                                              const std::vector<Point>& all_places,
                                              const FusionConfig& config) {
  blocks.resize(tsdf.size());
  now.reserve(tsdf.touched().size());
  found = tsdf.touched();
  std::sort(found.begin(), found.end(),
            [&](std::uint32_t a, std::uint32_t b) { return tsdf.index(a) < tsdf.index(b); });
  now.clear();
  for (const std::uint32_t number : found) now.push_back(blocks[number]);
  if (places_moved)
    for (Block& block : now) block.cleared = {};
  if (config.clear_radius > 0.0)
    for (std::size_t i = places_moved ? 0 : places; i < all_places.size(); ++i)
      clear_around(all_places[i], tsdf, config, *this);
  places_now = all_places.size();
  std::vector<VoxelMask::Block> changed(found.size());
  parallel_for_each_index(
      found.size(), [&](std::size_t i) { changed[i] = restate(tsdf.block(found[i]), now[i]); }, 16);
  std::vector<VoxelChange> changes;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t z = 0; z < kBlockSide; ++z)
      for (std::uint64_t bits = changed[i][z]; bits != 0; bits &= bits - 1) {
        const int place = std::countr_zero(bits);
        const VoxelIndex own = voxel_of(tsdf.index(found[i]), static_cast<int>(64 * z) + place);
        const VoxelState state = (now[i].free[z] >> place & 1) != 0    ? VoxelState::kFree
                                 : (now[i].known[z] >> place & 1) != 0 ? VoxelState::kOccupied
                                                                       : VoxelState::kUnknown;
        changes.push_back({origin + own, state});
      }
  return changes;
}

void AcceptedStates::accept(TsdfBlocks& tsdf) noexcept {
  for (std::size_t i = 0; i < found.size(); ++i) blocks[found[i]] = now[i];
  found.clear();
  places = places_now;
  places_moved = false;
  tsdf.forget_touched();
}

}  // namespace ridgeway::detail
