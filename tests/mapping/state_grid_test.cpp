// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mapping/state_grid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// A full box of random states, x slowest, unknown but for a part of it.
struct Box3 {
  std::array<int, 3> shape;
  std::vector<VoxelState> states;

  VoxelState& at(int x, int y, int z) {
    return states[static_cast<std::size_t>((x * shape[1] + y) * shape[2] + z)];
  }

  StateGrid grid(const VoxelIndex& low) {
    return {low, shape, [this](const VoxelIndex& first, const VoxelIndex& count, VoxelState* out) {
              for (int x = 0; x < count.x; ++x)
                for (int y = 0; y < count.y; ++y)
                  for (int z = 0; z < count.z; ++z)
                    out[x + 8 * y + 64 * z] = at(first.x + x, first.y + y, first.z + z);
            }};
  }
};

Box3 random_box(std::mt19937& random) {
  Box3 box;
  std::array<int, 3> from{}, to{};
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.shape[axis] = 1 + static_cast<int>(random() % 30);
    from[axis] = static_cast<int>(random() % 12);
    to[axis] = box.shape[axis] - static_cast<int>(random() % 12);
    count *= static_cast<std::size_t>(box.shape[axis]);
  }
  box.states.resize(count, VoxelState::kUnknown);
  for (int x = from[0]; x < to[0]; ++x)
    for (int y = from[1]; y < to[1]; ++y)
      for (int z = from[2]; z < to[2]; ++z) box.at(x, y, z) = static_cast<VoxelState>(random() % 3);
  return box;
}

TEST(StateGrid, GivesTheMapThatSingleVoxelsGive) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    Box3 box = random_box(random);
    const VoxelIndex low{static_cast<int>(random() % 40) - 20, -7, round};
    OccupancyBuilder voxels(0.1);
    bool any = false;
    for (int x = 0; x < box.shape[0]; ++x)
      for (int y = 0; y < box.shape[1]; ++y)
        for (int z = 0; z < box.shape[2]; ++z) {
          voxels.set(low + VoxelIndex{x, y, z}, box.at(x, y, z));
          any |= box.at(x, y, z) != VoxelState::kUnknown;
        }
    const OccupancyMap expected = std::move(voxels).finish();
    for (const int threads : {1, 2}) {
      const OccupancyMap map =
          with_threads(threads, [&] { return map_from_grid(box.grid(low), 0.1, "grid"); });
      EXPECT_EQ(map.layout, expected.layout);
      EXPECT_EQ(map.state.values(), expected.state.values());
      if (any) {
        EXPECT_EQ(map.origin, expected.origin);
      }
    }
  }
}

TEST(StateGrid, RefusesWhatLiesBeyondAllVoxels) {
  std::mt19937 random(2);
  Box3 box = random_box(random);
  box.shape = {1, 1, 1};
  EXPECT_NO_THROW(map_from_grid(box.grid({kMaxVoxelIndex, 0, 0}), 0.1, "grid"));
  box.shape = {1, 1, 2};
  box.states.resize(2);
  EXPECT_THROW(map_from_grid(box.grid({0, 0, kMaxVoxelIndex}), 0.1, "grid"), InputError);
  EXPECT_THROW(map_from_grid(box.grid({}), 0.0, "grid"), InputError);
  box.shape = {0, 5, 5};
  EXPECT_EQ(map_from_grid(box.grid({}), 0.1, "grid").layout.block_count(), 0u);
}

}  // namespace
}  // namespace ridgeway
