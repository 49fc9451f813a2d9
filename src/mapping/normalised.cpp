// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {
namespace {

/// The 8 blocks, a bit each, that a block of states brings a known voxel to when it is moved down
/// by less than a block: `off` of its first voxels fall into the lower blocks of each axis. Bit
/// x + 2 y + 4 z is of the lower or upper block of each.
unsigned known_parts(const VoxelState* states, const VoxelIndex& off) {
  unsigned parts = 0;
  for (int z = 0; z < kBlockSide; ++z)
    for (int y = 0; y < kBlockSide; ++y) {
      const VoxelState* row = states + local_of({0, y, z});
      const int part = 2 * static_cast<int>(y >= off.y) + 4 * static_cast<int>(z >= off.z);
      const auto look_at = [&](unsigned bit, int from, int to) {
        const auto is_known = [](VoxelState state) { return state != VoxelState::kUnknown; };
        if ((parts & bit) == 0 && std::any_of(row + from, row + to, is_known)) parts |= bit;
      };
      look_at(1u << part, 0, off.x);
      look_at(2u << part, off.x, kBlockSide);
    }
  return parts;
}

/// Blocks that hold a known voxel of a map whose voxel `low` becomes voxel (0, 0, 0).
std::vector<BlockIndex> blocks_after(const OccupancyMap& map, const VoxelIndex& low) {
  const VoxelIndex off{low.x & (kBlockSide - 1), low.y & (kBlockSide - 1),
                       low.z & (kBlockSide - 1)};
  std::vector<unsigned> parts(map.layout.block_count());
  parallel_for_each_index(
      parts.size(),
      [&](std::size_t slot) {
        parts[slot] = known_parts(map.state.block(static_cast<std::uint32_t>(slot)), off);
      },
      64);
  // In the order of the blocks, those of each part along y and z are in order too.
  std::vector<BlockIndex> blocks;
  const BlockIndex step{off.x != 0, off.y != 0, off.z != 0};
  for (int row = 0; row < 4; ++row) {
    const auto before = static_cast<std::ptrdiff_t>(blocks.size());
    for (std::uint32_t rank = 0; rank < map.layout.block_count(); ++rank) {
      // Voxels before `off` go to the block that the first of them falls into, the others to the
      // next.
      const std::uint32_t slot = map.layout.slot_at(rank);
      const BlockIndex first = block_of(voxel_of(map.layout.block(slot), 0) - low);
      for (int x = 0; x < 2; ++x) {
        if ((parts[slot] >> (2 * row + x) & 1u) == 0) continue;
        const BlockIndex block =
            first + BlockIndex{step.x * x, step.y * (row & 1), step.z * (row >> 1)};
        if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
      }
    }
    std::inplace_merge(blocks.begin(), blocks.begin() + before, blocks.end());
  }
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

/// Fills a block from the states that lie `low` away in the source: from up to 8 of its blocks, a
/// row at a time.
void fill_from(const OccupancyMap& source, const VoxelIndex& low, const BlockIndex& block,
               VoxelState* states) {
  const VoxelIndex corner = voxel_of(block, 0) + low;
  const BlockIndex first = block_of(corner),
                   last = block_of(corner +
                                   VoxelIndex{kBlockSide - 1, kBlockSide - 1, kBlockSide - 1});
  for (int bz = first.z; bz <= last.z; ++bz)
    for (int by = first.y; by <= last.y; ++by)
      for (int bx = first.x; bx <= last.x; ++bx) {
        const std::uint32_t slot = source.layout.find_block({bx, by, bz});
        if (slot == BlockLayout::kNoBlock) continue;
        const VoxelIndex step = voxel_of({bx, by, bz}, 0) - corner;  // of the two blocks' corners
        const VoxelIndex from{std::max(step.x, 0), std::max(step.y, 0), std::max(step.z, 0)};
        const VoxelIndex to{std::min(step.x, 0) + kBlockSide, std::min(step.y, 0) + kBlockSide,
                            std::min(step.z, 0) + kBlockSide};
        for (int z = from.z; z < to.z; ++z)
          for (int y = from.y; y < to.y; ++y)
            std::copy_n(source.state.block(slot) + local_of(VoxelIndex{from.x, y, z} - step),
                        to.x - from.x, states + local_of({from.x, y, z}));
      }
}

/// Throws InputError unless all voxels of a range of a map can be counted, in the world too.
void require_countable(const VoxelRange& known, const VoxelIndex& origin) {
  constexpr int kWidest = kMaxVoxelIndex / 2;  // as .ridge files have it
  require_within_reach(moved(known, origin), "map");
  if (known.max.x - known.min.x > kWidest || known.max.y - known.min.y > kWidest ||
      known.max.z - known.min.z > kWidest)
    throw InputError("map", "spans more than 5e8 voxels", "use a larger voxel size");
}

}  // namespace

OccupancyMap normalised(OccupancyMap map) {
  const VoxelRange known = known_range(map);
  const VoxelIndex low = known.empty() ? VoxelIndex{} : known.min;
  require_countable(known, map.origin);
  std::vector<BlockIndex> blocks = blocks_after(map, low);
  if (low == VoxelIndex{} && blocks.size() == map.layout.block_count()) return map;
  OccupancyMap result;
  result.voxel_size = map.voxel_size;
  result.origin = map.origin + low;
  result.planar = map.planar;
  result.layout = BlockLayout(std::move(blocks));
  result.state = VoxelField<VoxelState>(result.layout);
  parallel_for_each_index(
      result.layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        fill_from(map, low, result.layout.block(slot), result.state.block(slot));
      },
      16);
  return result;
}

}  // namespace ridgeway
