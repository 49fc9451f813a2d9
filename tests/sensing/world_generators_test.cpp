// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "sensing/world_generators.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

/// Number of openings between neighbouring cells, and of sets of cells that they join.
std::pair<int, std::size_t> count_openings(const World& maze, const MazeConfig& config) {
  const auto id = [&](int x, int y) { return static_cast<std::uint32_t>(y * config.cells + x); };
  DisjointSets sets(static_cast<std::size_t>(config.cells * config.cells));
  int openings = 0;
  for (int y = 0; y < config.cells; ++y)
    for (int x = 0; x < config.cells; ++x)
      for (const auto& [nx, ny] : {std::pair(x + 1, y), std::pair(x, y + 1)}) {
        if (nx >= config.cells || ny >= config.cells) continue;
        const Point here((x + 0.5) * config.cell, (y + 0.5) * config.cell, 1.0);
        const Eigen::Vector3d step(nx - x, ny - y, 0.0);
        if (cast_ray(maze, here, step) < config.cell) continue;
        ++openings;
        sets.join(id(x, y), id(nx, ny));
      }
  std::set<std::uint32_t> roots;
  for (int y = 0; y < config.cells; ++y)
    for (int x = 0; x < config.cells; ++x) roots.insert(sets.find(id(x, y)));
  return {openings, roots.size()};
}

TEST(Maze, JoinsAllCellsWithAsManyOpeningsAsAsked) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    MazeConfig config{.seed = seed};
    config.cells = 4 + static_cast<int>(seed % 7);
    config.extra_openings = static_cast<int>(seed % 3);
    const auto [openings, sets] = count_openings(make_maze(config), config);
    EXPECT_EQ(openings, config.cells * config.cells - 1 + config.extra_openings);
    EXPECT_EQ(sets, 1u);
  }
}

TEST(Maze, WallsAreAsThickAsAsked) {
  const World maze = make_maze({});
  for (const SolidBox& wall : maze.boxes)
    EXPECT_NEAR(std::min(wall.size.x(), wall.size.y()), 0.3, 1e-9);
  EXPECT_NE(make_maze({.seed = 2}).boxes[0].size, make_maze({.seed = 3}).boxes[0].size);
}

TEST(Hall, StaysInItsWallsAndLeavesRoomToFly) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const World hall = make_hall({.seed = seed});
    EXPECT_NO_THROW(validate_world(hall));
    EXPECT_GT(hall.boxes.size(), 15u);
    EXPECT_GT(hall.cylinders.size(), 5u);
    int open = 0, flyable = 0;
    for (double x = 0.25; x < 20.0; x += 0.5)
      for (double y = 0.25; y < 22.0; y += 0.5)
        for (double z = 0.25; z < 5.0; z += 0.5) {
          const double distance = surface_distance(hall, {x, y, z}).distance;
          open += distance > 0.0;
          flyable += distance > 0.5;
        }
    EXPECT_GT(open, 14000);  // of 17,600
    EXPECT_GT(flyable, 4000);
    EXPECT_LT(flyable, 14000);  // it is cluttered
  }
}

TEST(Generators, BadNumbersAreRefused) {
  EXPECT_THROW(make_maze({.cells = 1}), InputError);
  EXPECT_THROW(make_maze({.wall = 3.0}), InputError);
  EXPECT_THROW(make_maze({.extra_openings = -1}), InputError);
  EXPECT_THROW(make_hall({.length = 2.0}), InputError);
  EXPECT_THROW(make_hall({.tanks = -1}), InputError);
}

}  // namespace
}  // namespace ridgeway
