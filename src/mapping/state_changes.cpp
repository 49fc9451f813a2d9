// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "state_changes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "ridgeway/common/parallel.hpp"
#include "thin_surfaces.hpp"

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

/// What is known and open in a block.
void restate(const TsdfBlock& tsdf, AcceptedStates::Block& said) {
  const auto at = [](int v) { return static_cast<std::size_t>(v); };
  const VoxelMask::Block known = block_where([&](int v) { return tsdf.weight[at(v)] > 0.0f; });
  const VoxelMask::Block before = block_where([&](int v) { return tsdf.distance[at(v)] > 0.0f; });
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    said.known[z] = known[z] | said.cleared[z];
    said.open[z] = (known[z] & before[z]) | said.cleared[z];
  }
}

/// Open voxels at the sides of a block that were none, or the other way round.
bool sides_changed(const VoxelMask::Block& before, const VoxelMask::Block& now) {
  constexpr std::uint64_t kSides = 0xff818181818181ffu;
  std::uint64_t changed = (before.front() ^ now.front()) | (before.back() ^ now.back());
  for (std::size_t z = 1; z + 1 < kBlockSide; ++z) changed |= (before[z] ^ now[z]) & kSides;
  return changed != 0;
}

VoxelMask::Block free_of(const AcceptedStates::Block& block) {
  VoxelMask::Block free;
  for (std::size_t z = 0; z < kBlockSide; ++z) free[z] = block.open[z] & ~block.thin[z];
  return free;
}

}  // namespace

/// The blocks that were touched, by index.
void AcceptedStates::find_touched(const TsdfBlocks& tsdf) {
  for (const std::uint32_t number : found)
    place_of_[number] = kNotFound;  // of a search not accepted
  place_of_.resize(tsdf.size(), kNotFound);
  blocks.resize(tsdf.size());
  now.reserve(tsdf.touched().size());
  found = tsdf.touched();
  std::sort(found.begin(), found.end(),
            [&](std::uint32_t a, std::uint32_t b) { return tsdf.index(a) < tsdf.index(b); });
  now.clear();
  for (const std::uint32_t number : found) now.push_back(blocks[number]);
}

/// Blocks in which other voxels may be thin, as what is open beside them is another.
void AcceptedStates::add_blocks_beside(const TsdfBlocks& tsdf) {
  for (std::uint32_t i = 0; i < found.size(); ++i) place_of_[found[i]] = i;
  const std::size_t touched = found.size();
  for (std::size_t i = 0; i < touched; ++i) {
    if (!sides_changed(blocks[found[i]].open, now[i].open)) continue;
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex o = offset_of(d);
      const std::uint32_t beside = tsdf.number_of(tsdf.index(found[i]) + BlockIndex{o.x, o.y, o.z});
      if (beside == TsdfBlocks::kNone || place_of_[beside] != kNotFound) continue;
      place_of_[beside] = static_cast<std::uint32_t>(found.size());
      found.push_back(beside);
    }
  }
  if (found.size() == touched) return;
  for (std::size_t i = touched; i < found.size(); ++i) now.push_back(blocks[found[i]]);
  std::vector<std::uint32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return tsdf.index(found[a]) < tsdf.index(found[b]);
  });
  std::vector<std::uint32_t> numbers;
  std::vector<Block> states;
  for (const std::uint32_t i : order) {
    place_of_[found[i]] = static_cast<std::uint32_t>(numbers.size());
    numbers.push_back(found[i]);
    states.push_back(now[i]);
  }
  found.swap(numbers);
  now.swap(states);
}

const VoxelMask::Block* AcceptedStates::open_in(const TsdfBlocks& tsdf,
                                                const BlockIndex& index) const {
  const std::uint32_t number = tsdf.number_of(index);
  if (number == TsdfBlocks::kNone) return nullptr;
  return place_of_[number] == kNotFound ? &blocks[number].open : &now[place_of_[number]].open;
}

void AcceptedStates::find_thin(const TsdfBlocks& tsdf, const FusionConfig& config) {
  const auto limit = static_cast<float>(kNearSurface * config.voxel_size);
  parallel_for_each_index(
      found.size(),
      [&](std::size_t i) {
        Block& block = now[i];
        const std::array<float, kBlockVoxels>& distance = tsdf.block(found[i]).distance;
        VoxelMask::Block near =
            block_where([&](int v) { return distance[static_cast<std::size_t>(v)] < limit; });
        for (std::size_t z = 0; z < kBlockSide; ++z) near[z] &= block.open[z] & ~block.cleared[z];
        block.thin = thin_surfaces(near, block.open, [&](int direction) {
          const VoxelIndex o = offset_of(direction);
          return open_in(tsdf, tsdf.index(found[i]) + BlockIndex{o.x, o.y, o.z});
        });
      },
      16);
}

std::vector<VoxelChange> AcceptedStates::find(const TsdfBlocks& tsdf, const VoxelIndex& origin,
                                              const std::vector<Point>& all_places,
                                              const FusionConfig& config) {
  find_touched(tsdf);
  if (places_moved)
    for (Block& block : now) block.cleared = {};
  if (config.clear_radius > 0.0)
    for (std::size_t i = places_moved ? 0 : places; i < all_places.size(); ++i)
      clear_around(all_places[i], tsdf, config, *this);
  places_now = all_places.size();
  parallel_for_each_index(
      found.size(), [&](std::size_t i) { restate(tsdf.block(found[i]), now[i]); }, 16);
  add_blocks_beside(tsdf);
  find_thin(tsdf, config);
  std::vector<VoxelChange> changes;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Block& before = blocks[found[i]];
    const VoxelMask::Block was_free = free_of(before), free = free_of(now[i]);
    for (std::size_t z = 0; z < kBlockSide; ++z)
      for (std::uint64_t bits = (now[i].known[z] ^ before.known[z]) | (free[z] ^ was_free[z]);
           bits != 0; bits &= bits - 1) {
        const int place = std::countr_zero(bits);
        const VoxelIndex own = voxel_of(tsdf.index(found[i]), static_cast<int>(64 * z) + place);
        const VoxelState state = (free[z] >> place & 1) != 0           ? VoxelState::kFree
                                 : (now[i].known[z] >> place & 1) != 0 ? VoxelState::kOccupied
                                                                       : VoxelState::kUnknown;
        changes.push_back({origin + own, state});
      }
  }
  return changes;
}

void AcceptedStates::accept(TsdfBlocks& tsdf) noexcept {
  for (std::size_t i = 0; i < found.size(); ++i) {
    blocks[found[i]] = now[i];
    place_of_[found[i]] = kNotFound;
  }
  found.clear();
  places = places_now;
  places_moved = false;
  tsdf.forget_touched();
}

}  // namespace ridgeway::detail
