// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/surroundings.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "support/brute_force.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kVoxel = 0.1;

/// Voxels of one state in and two around a map's blocks, found one by one.
std::vector<VoxelIndex> all_of(const OccupancyMap& map, VoxelState state) {
  const VoxelIndex first = voxel_of(map.layout.block(0), 0);
  VoxelIndex low = first, high = first;
  for (const BlockIndex& b : map.layout.blocks()) {
    const VoxelIndex v = voxel_of(b, 0);
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  std::vector<VoxelIndex> found;
  for (int z = low.z - 2; z < high.z + kBlockSide + 2; ++z)
    for (int y = low.y - 2; y < high.y + kBlockSide + 2; ++y)
      for (int x = low.x - 2; x < high.x + kBlockSide + 2; ++x)
        if (map.at({x, y, z}) == state) found.push_back({x, y, z});
  return found;
}

std::vector<Point> random_path(const EsdfMap& esdf, std::mt19937& random) {
  std::vector<Point> path;
  const std::size_t points = 2 + random() % 3;
  while (path.size() < points) {
    const auto id = static_cast<VoxelId>(random() % esdf.layout.voxel_count());
    if (esdf.state[id] == VoxelState::kFree)
      path.emplace_back(
          centre_of(esdf.layout.index_of(id), esdf.voxel_size) +
          Point::Constant(0.2 * esdf.voxel_size * (static_cast<double>(random() % 5) - 2.0)));
  }
  return path;
}

/// Distances at many places of a path, by brute force, metres.
std::vector<double> distances_along(const std::vector<Point>& path, double step,
                                    const std::vector<VoxelIndex>& voxels) {
  std::vector<double> distances;
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  double before = 0.0;
  std::size_t i = 1;
  for (double at = 0.5 * step; at < length; at += step) {
    while (at > before + (path[i] - path[i - 1]).norm())
      before += (path[i] - path[i - 1]).norm(), ++i;
    const Point p = path[i - 1] + (path[i] - path[i - 1]).normalized() * (at - before);
    distances.push_back(kVoxel * std::sqrt(testing::brute_squared_distance(p / kVoxel, voxels)));
  }
  return distances;
}

TEST(Surroundings, DistancesToKnownAndUnknownAreThoseOfBruteForceUnderEveryPolicy) {
  constexpr double kStep = 0.05 * kVoxel;
  int paths = 0, near_both = 0, partly = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, 12, kVoxel);
    const auto policy = seed % 2 == 0 ? UnknownPolicy::kObstacle : UnknownPolicy::kIgnore;
    const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
    const std::vector<VoxelIndex> occupied = all_of(map, VoxelState::kOccupied);
    const std::vector<VoxelIndex> unknown = all_of(map, VoxelState::kUnknown);
    const Surroundings around(esdf);
    std::mt19937 random(seed);
    for (int i = 0; i < 6; ++i, ++paths) {
      const std::vector<Point> path = random_path(esdf, random);
      const double radius = 0.05 + 0.05 * static_cast<double>(random() % 6);
      const PathSurroundings found = around.along(path, radius);
      const auto known = distances_along(path, kStep, occupied);
      const auto to_unknown = distances_along(path, kStep, unknown);
      if (known.empty()) continue;
      const double least_known = *std::min_element(known.begin(), known.end());
      const double least_unknown = *std::min_element(to_unknown.begin(), to_unknown.end());
      if (occupied.empty()) {
        EXPECT_TRUE(std::isinf(found.known));
      } else {
        EXPECT_NEAR(found.known, least_known, kStep);
      }
      EXPECT_NEAR(found.unknown, least_unknown, kStep);
      const auto share_at = [&](double r) {
        return static_cast<double>(std::count_if(to_unknown.begin(), to_unknown.end(),
                                                 [&](double d) { return d < r; })) /
               static_cast<double>(to_unknown.size());
      };
      const double off = 2.0 / static_cast<double>(to_unknown.size());
      EXPECT_GE(found.unknown_share, share_at(radius - kVoxel / 16.0) - off);
      EXPECT_LE(found.unknown_share, share_at(radius + kVoxel / 16.0) + off);
      near_both += found.known < 0.3 && found.unknown < 0.3;
      partly += found.unknown_share > 0.05 && found.unknown_share < 0.95;
      // What the policy takes for an obstacle is what the clearance is measured to.
      const double clearance = FreeSpace(esdf).clearance(path);
      const double expected =
          policy == UnknownPolicy::kObstacle ? std::min(found.known, found.unknown) : found.known;
      if (std::isfinite(expected)) {
        EXPECT_NEAR(clearance, expected, 1e-9);
      }
    }
  }
  EXPECT_GT(paths, 60);
  EXPECT_GT(near_both, 15);
  EXPECT_GT(partly, 10);
}

/// A room, 6 m along x, whose floor was seen up to x = 2 m; nothing else around it was.
OccupancyMap half_seen_room() {
  return testing::make_map(kVoxel, {0, 0, 0}, {59, 39, 39}, [](const VoxelIndex& v) {
    if (v.z == 0) return v.x < 20 ? VoxelState::kOccupied : VoxelState::kUnknown;
    return VoxelState::kFree;
  });
}

TEST(Surroundings, TellHowMuchOfAPathIsTooNearToTheUnknown) {
  for (const auto policy : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore}) {
    const EsdfMap esdf = compute_esdf(half_seen_room(), {.unknown = policy});
    const Surroundings around(esdf);
    const std::array<Point, 3> path{Point(0.75, 2.0, 0.5), Point(2.0, 2.0, 0.5),
                                    Point(4.75, 2.0, 0.5)};
    const PathSurroundings found = around.along(path, 0.45);
    EXPECT_NEAR(found.known, 0.4, 1e-12);
    EXPECT_NEAR(found.unknown, 0.4, 1e-12);
    // From where the unknown floor, 0.4 m below, begins to be nearer than 0.45 m.
    const double begins = 2.0 - std::sqrt(0.45 * 0.45 - 0.4 * 0.4);
    EXPECT_NEAR(found.unknown_share, (4.75 - begins) / 4.0, 0.01);
    EXPECT_EQ(around.along(path, 0.4).unknown_share, 0.0);  // all of it keeps just that radius
    EXPECT_EQ(around.along(path, 5.0).unknown_share, 1.0);
    EXPECT_NEAR(around.along(std::span(path).first(1), 0.5).unknown, 0.5, 1e-12);  // below
  }
}

TEST(Surroundings, FarFromEverythingAndWithoutAnything) {
  // Two pieces of space, far apart; all that is occupied lies in the second.
  OccupancyMap map;
  map.voxel_size = kVoxel;
  map.layout = BlockLayout({{0, 0, 0}, {5000, 3000, 0}});
  map.state = VoxelField<VoxelState>(map.layout);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id) map.state[id] = VoxelState::kFree;
  map.state[map.layout.find({40000, 24000, 0})] = VoxelState::kOccupied;
  const EsdfMap esdf = compute_esdf(map);
  const std::array<Point, 2> path{Point(0.35, 0.35, 0.35), Point(0.45, 0.35, 0.35)};
  const PathSurroundings found = Surroundings(esdf).along(path, 0.3);
  EXPECT_NEAR(found.unknown, 0.35, 1e-12);
  EXPECT_NEAR(found.known, Point(4000.0 - 0.45, 2400.0 - 0.35, 0.25).norm(), 1e-9);
  const PathSurroundings nothing = Surroundings(esdf).along({}, 0.3);
  EXPECT_TRUE(std::isinf(nothing.known) && std::isinf(nothing.unknown));
  EXPECT_EQ(nothing.unknown_share, 0.0);
  const std::array<Point, 2> outside{Point(-9.0, 0.35, 0.35), Point(-8.0, 0.35, 0.35)};
  EXPECT_EQ(Surroundings(esdf).along(outside, 0.3).unknown, 0.0);
  EXPECT_EQ(Surroundings(esdf).along(outside, 0.3).unknown_share, 1.0);
}

}  // namespace
}  // namespace ridgeway
