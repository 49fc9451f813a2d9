// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "esdf/cylinder_room.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ridgeway/esdf/free_space.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::CylinderRoom;
using Answer = detail::CylinderRoom::Answer;

/// The answer when it has been asked for often enough.
Answer ask(CylinderRoom& room, VoxelId from, VoxelId to) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(room.ask(from, to), Answer::kUnclear);
  return room.ask(from, to);
}

struct Counts {
  int free = 0, shut = 0, unclear = 0;
};

/// Holds what is said of moves against a look at all obstacles.
void expect_as_measured(const EsdfMap& esdf, double radius, double height, int moves,
                        std::mt19937& random, Counts& counts) {
  const FlightLimits no_limits;
  const double s = esdf.voxel_size;
  const FreeSpace space(esdf, no_limits, radius, height);
  CylinderRoom room(esdf, radius / s, 0.5 * height / s);
  const FreeSpace quick(space, room);
  for (int i = 0; i < 100; ++i) room.ask(0, 0);  // while few were asked for nothing is clear
  const SquaredHalves threshold = least_clearance(space.inner_radius(radius), s);
  for (int i = 0; i < moves; ++i) {
    const auto from = static_cast<VoxelId>(random() % esdf.layout.voxel_count());
    const auto direction = static_cast<int>(random() % 27);
    const VoxelId to = esdf.layout.neighbour(from, direction);
    if (direction == kCentre || to == kNoVoxel || !esdf.is_open(from) || !esdf.is_open(to))
      continue;
    const VoxelIndex a = esdf.layout.index_of(from), b = esdf.layout.index_of(to);
    const bool is_free = space.is_free(centre_of(a, s), centre_of(b, s), radius);
    const Answer answer = room.ask(from, to);
    counts.free += answer == Answer::kFree;
    counts.shut += answer == Answer::kShut;
    counts.unclear += answer == Answer::kUnclear;
    if (answer != Answer::kUnclear)
      EXPECT_EQ(answer == Answer::kFree, is_free)
          << radius / s << " " << height / s << " " << direction << " " << a.x << " " << a.y << " "
          << a.z;
    EXPECT_EQ(quick.move_is_free(from, to, direction, threshold), is_free);
  }
}

TEST(CylinderRoom, SaysOfMovesWhatALookAtAllObstaclesSays) {
  for (const UnknownPolicy unknown : {UnknownPolicy::kObstacle, UnknownPolicy::kFree}) {
    Counts counts;
    for (unsigned seed = 0; seed < 30; ++seed) {
      SCOPED_TRACE(seed);
      std::mt19937 random(seed);
      const unsigned sparse = seed % 3 == 0 ? 200 : 3000;
      const OccupancyMap map =
          testing::make_map(0.1, {-5, 2, 7}, {40, 43, 44}, [&](const VoxelIndex& v) {
            if (v.z < 9 && unknown == UnknownPolicy::kFree) return VoxelState::kUnknown;
            return random() % sparse == 0 ? VoxelState::kOccupied : VoxelState::kFree;
          });
      const EsdfMap esdf = compute_esdf(map, {.unknown = unknown});
      std::uniform_real_distribution<double> unit(0.0, 1.0);
      for (int i = 0; i < 8; ++i) {
        double radius = 0.02 + (i % 2 == 0 ? 0.3 : 1.4) * unit(random);
        double height = 0.02 + (i % 3 == 0 ? 0.3 : 3.0) * unit(random);
        // Those that only just fit: between walls that are whole voxels apart.
        if (i % 4 == 0) radius = 0.05 + 0.1 * static_cast<double>(random() % 6);
        if (i % 4 == 1) height = 0.1 * static_cast<double>(1 + random() % 9);
        expect_as_measured(esdf, radius, height, 1500, random, counts);
      }
    }
    EXPECT_GT(counts.free, 2000);
    EXPECT_GT(counts.shut, 2000);
    EXPECT_LT(counts.unclear, (counts.free + counts.shut) / 10);
  }
}

TEST(CylinderRoom, LeavesWhatIsTooLargeForItOpen) {
  const OccupancyMap map =
      testing::make_map(0.1, {0, 0, 0}, {9, 9, 9}, [](auto) { return VoxelState::kFree; });
  const EsdfMap esdf = compute_esdf(map, {.unknown = UnknownPolicy::kFree});
  const VoxelId from = esdf.layout.find({4, 4, 4}), to = esdf.layout.find({5, 4, 4});
  const auto answer = [&](double radius, double half_height) {
    CylinderRoom room(esdf, radius, half_height);
    return ask(room, from, to);
  };
  EXPECT_EQ(answer(100.0, 900.0), Answer::kFree);
  EXPECT_EQ(answer(130.0, 1.0), Answer::kUnclear);
  EXPECT_EQ(answer(1.0, 1e9), Answer::kUnclear);
  EXPECT_EQ(answer(1e300, 1e300), Answer::kUnclear);
}

}  // namespace
}  // namespace ridgeway
