// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "measured_moves.hpp"

#include <utility>
#include <vector>

#include "remembered_space.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/cube_gather.hpp"

namespace ridgeway::detail {

MeasuredMoves::MeasuredMoves(const RememberedSpace& space, const VoxelMask& among) {
  const BlockLayout& layout = space.map().layout;
  std::vector<std::vector<std::pair<OfMove, double>>> of_block(among.block_count());
  parallel_for_each_index(
      among.block_count(),
      [&](std::size_t block) {
        for_each_member(among, static_cast<std::uint32_t>(block), [&](VoxelId id) {
          constexpr Cube27 kForward = kCells26 >> (kCentre + 1) << (kCentre + 1);
          for (Cube27 cube = cube_around(layout, among, id) & kForward; cube != 0;
               cube &= cube - 1) {
            const int d = std::countr_zero(cube);
            const VoxelId other = layout.neighbour(id, d);
            if (!space.is_level(id, other, d))
              of_block[block].emplace_back(move_from(id, d),
                                           space.move_clearance(id, other, d).value);
          }
        });
      },
      16);
  std::size_t count = 0;
  for (const auto& moves : of_block) count += moves.size();
  clearance_.reserve(count);
  for (const auto& moves : of_block)
    for (const auto& [move, clearance] : moves) clearance_.add(move, mixed(move), clearance);
}

}  // namespace ridgeway::detail
