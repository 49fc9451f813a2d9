// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "state_changes.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "ridgeway/common/parallel.hpp"
#include "thin_surfaces.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

/// Marks where the robot was, in the blocks that are looked at.
void clear_around(const Point& place, const TsdfBlocks& tsdf, const FusionConfig& config,
                  std::vector<AcceptedStates::Found>& blocks) {
  for_each_in_sphere(place, config.clear_radius, config.voxel_size, [&](const VoxelIndex& v) {
    const auto block = std::lower_bound(blocks.begin(), blocks.end(), block_of(v),
                                        [&](const AcceptedStates::Found& f, const BlockIndex& b) {
                                          return tsdf.index(f.number) < b;
                                        });
    if (block == blocks.end() || tsdf.index(block->number) != block_of(v)) return;
    const int local = local_of(v);
    block->cleared[static_cast<std::size_t>(local / 64)] |= 1ull << (local % 64);
  });
}

VoxelMask::Block measured_in(const TsdfBlock& tsdf) {
  return block_where([&](int v) { return tsdf.weight[static_cast<std::size_t>(v)] > 0.0f; });
}

void find_vouched(const VoxelMask::Block& measured, AcceptedStates::Found& block) {
  for (std::size_t z = 0; z < kBlockSide; ++z) block.vouched[z] = block.cleared[z] & ~measured[z];
}

/// What is known and open in a block. Where the robot was, what nothing measured is free; what was
/// measured stays as it is.
void restate(const TsdfBlock& tsdf, AcceptedStates::Found& block) {
  const auto at = [](int v) { return static_cast<std::size_t>(v); };
  const VoxelMask::Block known = measured_in(tsdf);
  const VoxelMask::Block before = block_where([&](int v) { return tsdf.distance[at(v)] > 0.0f; });
  find_vouched(known, block);
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    block.now.known[z] = known[z] | block.cleared[z];
    block.now.open[z] = (known[z] & before[z]) | block.vouched[z];
  }
}

/// Open voxels at the sides of a block that were none, or the other way round.
bool sides_changed(const VoxelMask::Block& before, const VoxelMask::Block& now) {
  constexpr std::uint64_t kSides = 0xff818181818181ffu;
  std::uint64_t changed = (before.front() ^ now.front()) | (before.back() ^ now.back());
  for (std::size_t z = 1; z + 1 < kBlockSide; ++z) changed |= (before[z] ^ now[z]) & kSides;
  return changed != 0;
}

}  // namespace

VoxelMask::Block AcceptedStates::Block::free() const { return both(known, open); }

void AcceptedStates::add_found(std::uint32_t number) {
  found.push_back({number, blocks[number], {}});
  place_of_[number] = 0;  // until they are sorted
  if (!cleared.empty()) found.back().cleared = cleared[number];
}

void AcceptedStates::sort_found(const TsdfBlocks& tsdf) {
  std::sort(found.begin(), found.end(), [&](const Found& a, const Found& b) {
    return tsdf.index(a.number) < tsdf.index(b.number);
  });
  for (std::uint32_t i = 0; i < found.size(); ++i) place_of_[found[i].number] = i;
}

/// The blocks that were touched.
void AcceptedStates::find_touched(const TsdfBlocks& tsdf, bool clears) {
  for (const Found& block : found) place_of_[block.number] = kNotFound;  // not accepted
  found.clear();
  place_of_.resize(tsdf.size(), kNotFound);
  blocks.resize(tsdf.size());
  if (clears) cleared.resize(tsdf.size());
  found.reserve(tsdf.touched().size());
  for (const std::uint32_t number : tsdf.touched()) add_found(number);
  sort_found(tsdf);
}

/// Blocks in which other voxels may be thin, as what is open beside them is another.
void AcceptedStates::add_blocks_beside(const TsdfBlocks& tsdf) {
  const std::size_t touched = found.size();
  for (std::size_t i = 0; i < touched; ++i) {
    const std::uint32_t number = found[i].number;
    if (!sides_changed(blocks[number].open, found[i].now.open)) continue;
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex o = offset_of(d);
      const std::uint32_t beside = tsdf.number_of(tsdf.index(number) + BlockIndex{o.x, o.y, o.z});
      if (beside == TsdfBlocks::kNone || place_of_[beside] != kNotFound) continue;
      add_found(beside);
      if (!cleared.empty()) find_vouched(measured_in(tsdf.block(beside)), found.back());
    }
  }
  if (found.size() > touched) sort_found(tsdf);
}

const VoxelMask::Block* AcceptedStates::open_in(const TsdfBlocks& tsdf,
                                                const BlockIndex& index) const {
  const std::uint32_t number = tsdf.number_of(index);
  if (number == TsdfBlocks::kNone) return nullptr;
  return place_of_[number] == kNotFound ? &blocks[number].open : &found[place_of_[number]].now.open;
}

void AcceptedStates::find_thin(const TsdfBlocks& tsdf, const FusionConfig& config) {
  const auto limit = static_cast<float>(kNearSurface * config.voxel_size);
  parallel_for_each_index(
      found.size(),
      [&](std::size_t i) {
        Found& block = found[i];
        const std::array<float, kBlockVoxels>& distance = tsdf.block(block.number).distance;
        VoxelMask::Block near =
            block_where([&](int v) { return distance[static_cast<std::size_t>(v)] < limit; });
        const VoxelMask::Block& open = block.now.open;
        for (std::size_t z = 0; z < kBlockSide; ++z) near[z] &= open[z] & ~block.vouched[z];
        const VoxelMask::Block thin = thin_surfaces(near, open, [&](int direction) {
          const VoxelIndex o = offset_of(direction);
          return open_in(tsdf, tsdf.index(block.number) + BlockIndex{o.x, o.y, o.z});
        });
        for (std::size_t z = 0; z < kBlockSide; ++z)
          block.now.known[z] = (block.now.known[z] | open[z]) & ~thin[z];
      },
      16);
}

std::vector<VoxelChange> AcceptedStates::find(const TsdfBlocks& tsdf, const VoxelIndex& origin,
                                              const std::vector<Point>& all_places,
                                              const FusionConfig& config) {
  find_touched(tsdf, config.clear_radius > 0.0);
  if (places_moved)
    for (Found& block : found) block.cleared = {};
  if (config.clear_radius > 0.0)
    for (std::size_t i = places_moved ? 0 : places; i < all_places.size(); ++i)
      clear_around(all_places[i], tsdf, config, found);
  places_now = all_places.size();
  parallel_for_each_index(
      found.size(), [&](std::size_t i) { restate(tsdf.block(found[i].number), found[i]); }, 16);
  add_blocks_beside(tsdf);
  find_thin(tsdf, config);
  std::vector<VoxelChange> changes;
  for (const Found& block : found) {
    const Block& before = blocks[block.number];
    const VoxelMask::Block was_free = before.free(), free = block.now.free();
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t known = block.now.known[z] | block.now.open[z];
      const std::uint64_t was_known = before.known[z] | before.open[z];
      for (std::uint64_t bits = (known ^ was_known) | (free[z] ^ was_free[z]); bits != 0;
           bits &= bits - 1) {
        const int place = std::countr_zero(bits);
        const VoxelIndex own = voxel_of(tsdf.index(block.number), static_cast<int>(64 * z) + place);
        const VoxelState state = (free[z] >> place & 1) != 0 ? VoxelState::kFree
                                 : (known >> place & 1) != 0 ? VoxelState::kOccupied
                                                             : VoxelState::kUnknown;
        changes.push_back({origin + own, state});
      }
    }
  }
  return changes;
}

void AcceptedStates::accept(TsdfBlocks& tsdf) noexcept {
  for (const Found& block : found) {
    blocks[block.number] = block.now;
    if (!cleared.empty()) cleared[block.number] = block.cleared;
    place_of_[block.number] = kNotFound;
  }
  found.clear();
  places = places_now;
  places_moved = false;
  tsdf.forget_touched();
}

}  // namespace ridgeway::detail
