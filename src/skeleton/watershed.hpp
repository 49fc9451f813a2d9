// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "esdf/remembered_space.hpp"
#include "ridgeway/skeleton/basins.hpp"
#include "voxel/cube_gather.hpp"

namespace ridgeway::detail {

/// A peak or a possible pass: a voxel whose higher neighbours do not all hang together.
struct CriticalVoxel {
  VoxelId id;
  Cube27 higher;
  friend bool operator==(const CriticalVoxel&, const CriticalVoxel&) = default;
};

/// What one look at every traversable voxel and its neighbours tells.
struct Watershed {
  Basins basins;                        ///< without passes and dynamics
  std::vector<CriticalVoxel> critical;  ///< in the order of voxels
};

/// What the look at one block's voxels tells, but for the directions.
struct BlockWays {
  std::uint32_t top = 0;  ///< highest level
  bool has_peak = false;
  std::vector<CriticalVoxel> critical;  ///< ascending
};

/// What is known of each block by itself: of its voxels and those around them alone.
struct LocalWays {
  VoxelField<Direction> next;  ///< as in Basins
  VoxelMask not_simple_at_first_turn;
  std::vector<BlockWays> blocks;  ///< by slot

  /// Follows a layout to which blocks were added since, none of whose voxels is traversable.
  void grow(const BlockLayout& layout);
};

/// Looks at the voxels of some blocks, each named once; the others stay as they are.
void look_at_blocks(const EsdfMap& esdf, const VoxelMask& traversable,
                    std::span<const std::uint32_t> slots, LocalWays& ways);

/// Where each place's way ends as long as it stays in the block.
std::array<std::uint16_t, kBlockVoxels> ends_in_block(const VoxelMask& traversable,
                                                      std::uint32_t slot, const Direction* next);

/// The basins of a block's voxels, each once and the one of the first voxel first, and which of
/// them each voxel is in. `basin_at(id)`: of a voxel from which the way leaves the block, and of a
/// peak.
template <typename BasinAt>
BasinNumbers::InBlock basins_in_block(const VoxelMask& traversable, std::uint32_t slot,
                                      const Direction* next, const BasinAt& basin_at) {
  BasinNumbers::InBlock found;
  const std::array<std::uint16_t, kBlockVoxels> end = ends_in_block(traversable, slot, next);
  std::array<std::uint16_t, kBlockVoxels> place_of_end{};
  for_each_member(traversable, slot, [&](VoxelId id) {
    const VoxelId place = id % kBlockVoxels;
    if (end[place] != place) return;
    const std::uint32_t basin = basin_at(id);
    const auto same = std::find(found.basins.begin(), found.basins.end(), basin);
    place_of_end[place] = static_cast<std::uint16_t>(same - found.basins.begin());
    if (same == found.basins.end()) found.basins.push_back(basin);
  });
  if (found.basins.size() < 2) return found;
  const unsigned bits =
      std::bit_ceil(static_cast<unsigned>(std::bit_width(found.basins.size() - 1)));
  found.place.assign(kBlockVoxels * bits / 8, 0);
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    const unsigned place = static_cast<unsigned>(place_of_end[end[i]]) << i * bits % 8;
    found.place[i * bits / 8] |= static_cast<std::uint8_t>(place);
    if (bits == 16) found.place[i * 2 + 1] = static_cast<std::uint8_t>(place >> 8);
  }
  return found;
}

/// The direction to the block that a step out of a block leads to.
int block_direction(VoxelId place, Direction next);

/// Of the higher neighbours those that hang together with one in another basin: by which a critical
/// voxel may join two.
Cube27 higher_in_others(const BlockLayout& layout, const BasinNumbers& basin,
                        const CriticalVoxel& voxel);

/// Numbers the basins. `local` has the local results; blocks those that belong to it.
Watershed watershed_of(const EsdfMap& esdf, const VoxelMask& traversable,
                       const std::vector<BlockWays>& blocks, Basins local);

/// Leads every voxel to its peak by the steepest of the ways that do not dip.
///
/// Plain form: plain_watershed.hpp, plain_climb() for each voxel. From it, docs/fast-kernels.md
/// section 3: critical voxels by a local test (2), peaks by whole blocks (7), four voxels at a time
/// (8); voxels not simple at their first turn, section 4 (2).
Watershed find_watershed(const EsdfMap& esdf, const VoxelMask& traversable);

/// The rest of find_basins.
Basins find_passes(const RememberedSpace& space, double radius, Watershed watershed);

}  // namespace ridgeway::detail
