// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/free_space.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

#include "ridgeway/esdf/esdf.hpp"
#include "support/brute_force.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::all_obstacles;
using testing::brute_squared_distance;
using testing::random_map;

constexpr double kTiny = 1e-7;

/// Points that matter: voxel centres, and anywhere.
Point random_point(const EsdfMap& esdf, std::mt19937& random) {
  VoxelId id = 0;
  for (int tries = 0; tries < 60; ++tries) {  // mostly well inside free space
    id = static_cast<VoxelId>(random() % esdf.layout.voxel_count());
    if (esdf.state[id] == VoxelState::kFree && esdf.squared[id] > (tries < 40 ? 9u : 0u)) break;
  }
  const VoxelIndex v = esdf.layout.index_of(id);
  if (random() % 3 == 0) return centre_of(v, esdf.voxel_size);
  std::uniform_real_distribution<double> inside(0.0, 1.0);
  return (Point(v.x, v.y, v.z) + Point(inside(random), inside(random), inside(random))) *
         esdf.voxel_size;
}

class FreeSpaceOnRandomMaps : public ::testing::TestWithParam<UnknownPolicy> {};

TEST_P(FreeSpaceOnRandomMaps, DistanceEqualsBruteForceAtAnyPoint) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const OccupancyMap map = random_map(seed);
    const EsdfMap esdf = compute_esdf(map, {.unknown = GetParam()});
    const std::vector<VoxelIndex> obstacles = all_obstacles(map, GetParam());
    const FreeSpace space(esdf);
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i) {
      const Point p = random_point(esdf, random);
      const double brute =
          esdf.voxel_size * std::sqrt(brute_squared_distance(p / esdf.voxel_size, obstacles));
      if (std::isinf(brute)) {
        ASSERT_TRUE(std::isinf(space.distance(p)));
      } else {
        ASSERT_NEAR(space.distance(p), brute, kTiny) << "seed " << seed;
      }
    }
  }
}

TEST_P(FreeSpaceOnRandomMaps, SegmentsAgreeWithBruteForce) {
  int free_segments = 0, decided = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const OccupancyMap map = random_map(seed, 14);
    const EsdfMap esdf = compute_esdf(map, {.unknown = GetParam()});
    const std::vector<VoxelIndex> obstacles = all_obstacles(map, GetParam());
    if (obstacles.empty()) continue;
    const FreeSpace space(esdf);
    std::mt19937 random(seed + 1000);
    for (int i = 0; i < 12; ++i) {
      const Point a = random_point(esdf, random);
      const Point b = i % 4 == 0 ? random_point(esdf, random)
                                 : Point(a + 0.35 * (random_point(esdf, random) - a).normalized());
      const double s = esdf.voxel_size;
      const double brute = s * std::sqrt(brute_squared_distance(a / s, b / s, obstacles));
      const double clearance = space.clearance(a, b);
      const std::array path{a, b};
      for (const double at_most : {0.5 * clearance, clearance, 1.1 * clearance, 1e3})
        ASSERT_NEAR(space.clearance(path, at_most), std::min(clearance, at_most), kTiny);
      ASSERT_NEAR(clearance, brute, kTiny);
      if (GetParam() == UnknownPolicy::kIgnore && !space.is_known_free(a, b)) {
        EXPECT_FALSE(space.is_free(a, b, 0.05));
        continue;
      }
      for (const double radius : {0.05, 0.1, 0.15, 0.25, clearance * 0.999, clearance * 1.001}) {
        if (radius <= 0.0) continue;
        ++decided;
        free_segments += space.is_free(a, b, radius);
        ASSERT_EQ(space.is_free(a, b, radius), clearance >= radius * (1 - 1e-9))
            << "seed " << seed << " radius " << radius << " clearance " << clearance;
      }
    }
  }
  EXPECT_GT(free_segments, decided / 20);  // the test sees both answers
  EXPECT_LT(free_segments, decided * 19 / 20);
}

TEST_P(FreeSpaceOnRandomMaps, MovesBetweenVoxelsAgreeWithTheSegmentPredicate) {
  int dips = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const EsdfMap esdf = compute_esdf(random_map(seed), {.unknown = GetParam()});
    const FreeSpace space(esdf);
    for (VoxelId id = seed % 3; id < esdf.layout.voxel_count(); id += 3) {
      if (esdf.state[id] != VoxelState::kFree || esdf.squared[id] == kNoSite) continue;
      const int d = static_cast<int>((id / 3) % 27);
      const VoxelId to = esdf.layout.neighbour(id, d);
      if (d == kCentre || to == kNoVoxel || esdf.state[to] != VoxelState::kFree) continue;
      if (esdf.squared[to] == kNoSite) continue;
      const Point a = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
      const Point b = centre_of(esdf.layout.index_of(to), esdf.voxel_size);
      const double clearance = space.move_clearance(id, to, d).metres(esdf.voxel_size);
      ASSERT_NEAR(clearance, space.clearance(a, b), kTiny);
      dips += clearance < std::min(esdf.distance(id), esdf.distance(to)) - kTiny;
      for (const double radius : {0.05, 0.1, 0.15, 0.2, 0.3, clearance})
        ASSERT_EQ(space.move_is_free(id, to, d, least_clearance(radius, esdf.voxel_size)),
                  space.is_free(a, b, radius))
            << "radius " << radius << " clearance " << clearance;
    }
  }
  EXPECT_GT(dips, 100);  // moves that are narrower than both their ends do occur
}

TEST_P(FreeSpaceOnRandomMaps, FreeLengthEndsWithinAVoxelOfTheFirstPlaceThatIsTooNear) {
  constexpr int kSteps = 2000;
  int all = 0, part = 0, shorter = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(random_map(seed, 16), {.unknown = GetParam()});
    const FreeSpace space(esdf);
    std::mt19937 random(seed + 2000);
    for (int i = 0; i < 20; ++i) {
      const Point a = random_point(esdf, random), b = random_point(esdf, random);
      const double length = (b - a).norm(), s = esdf.voxel_size;
      for (const double radius : {0.05, 0.1, 0.15, 0.25}) {
        const double free = space.free_length(a, b, radius);
        ASSERT_GE(free, 0.0);
        ASSERT_LE(free, length);
        ASSERT_EQ(free == length, space.is_free(a, b, radius) || length == 0.0);
        if (free > 0.0) {
          ASSERT_TRUE(space.is_free(a, a + (b - a) * (free / length), radius));
        }
        const double clear = space.clear_length(a, b, radius);
        ASSERT_GE(clear, 0.0);
        ASSERT_LE(clear, free + s);  // where unknown space ends both they are off by a voxel
        ASSERT_EQ(clear == length, space.is_clearly_free(a, b, radius) || length == 0.0);
        shorter += clear < free;
        ++(free == length ? all : part);
        if (free == length) continue;
        double first = length;  // place that is too near, or unknown; it may begin a step before
        for (int k = kSteps; k >= 0; --k) {
          const Point p = a + (b - a) * (static_cast<double>(k) / kSteps);
          if (!space.is_free(p, radius)) first = length * k / kSteps;
        }
        first -= length / kSteps;
        ASSERT_GE(free, first - s * (1.0 + 1e-9)) << "first " << first << " radius " << radius;
      }
    }
  }
  EXPECT_GT(all, 100);
  EXPECT_GT(part, 1000);
  EXPECT_GT(shorter, 100);
}

TEST_P(FreeSpaceOnRandomMaps, ClearlyFreeIsFreeAndHardlyDoubtsMore) {
  int sure = 0, doubted = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(random_map(seed, 24), {.unknown = GetParam()});
    const FreeSpace space(esdf);
    std::mt19937 random(seed + 3000);
    for (int i = 0; i < 40; ++i) {
      const Point a = random_point(esdf, random);
      const Point b = a + 0.6 * (random_point(esdf, random) - a);
      const double clearance = space.clearance(a, b);
      for (const double radius : {0.05, 0.1, 0.2, clearance * 0.9, clearance, clearance * 1.001}) {
        if (!(radius > 0.0) || std::isinf(radius)) continue;
        const bool is_sure = space.is_clearly_free(a, b, radius);
        ++(is_sure ? sure : doubted);
        if (is_sure) {
          ASSERT_TRUE(space.is_free(a, b, radius)) << "radius " << radius;
        } else if (space.is_free(a, b, radius)) {
          ASSERT_LE(clearance - radius, 0.75 * esdf.voxel_size) << "clearance " << clearance;
        }
      }
    }
  }
  EXPECT_GT(sure, 300);
  EXPECT_GT(doubted, 300);
}

TEST_P(FreeSpaceOnRandomMaps, NearObstacleIsThatOfTheVoxelsCentre) {
  int found = 0, none = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = random_map(seed);
    const double most = seed % 2 == 0 ? std::numeric_limits<double>::infinity() : 0.3;
    const EsdfMap esdf = compute_esdf(map, {.unknown = GetParam(), .max_distance = most});
    const std::vector<VoxelIndex> obstacles = all_obstacles(map, GetParam());
    const FreeSpace space(esdf);
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i) {
      const Point p = random_point(esdf, random);
      const VoxelIndex voxel = voxel_at(p, esdf.voxel_size);
      const Eigen::Vector3d centre = centre_of(voxel, 1.0);
      const double brute = std::sqrt(brute_squared_distance(centre, obstacles)) * esdf.voxel_size;
      const std::optional<Point> near = space.near_obstacle(p);
      ASSERT_EQ(near.has_value(), brute <= most + kTiny) << brute;
      ++(near ? found : none);
      if (!near) continue;
      EXPECT_NEAR(brute_squared_distance(*near / esdf.voxel_size, obstacles), 0.0, kTiny);
      // The cube that holds it is as near to the centre as any, and it is that cube's nearest.
      const VoxelId id = esdf.layout.find(voxel);
      const SiteOffset o = esdf.site[id];
      const std::vector<VoxelIndex> cube{voxel + VoxelIndex{o.x, o.y, o.z}};
      EXPECT_NEAR(std::sqrt(brute_squared_distance(centre, cube)) * esdf.voxel_size, brute, kTiny);
      EXPECT_NEAR((*near - p).norm(),
                  std::sqrt(brute_squared_distance(p / esdf.voxel_size, cube)) * esdf.voxel_size,
                  kTiny);
    }
    EXPECT_FALSE(space.near_obstacle(Point(1e3, 0, 0)).has_value());
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(none, 20);
}

INSTANTIATE_TEST_SUITE_P(BothPolicies, FreeSpaceOnRandomMaps,
                         ::testing::Values(UnknownPolicy::kObstacle, UnknownPolicy::kIgnore));

TEST(FreeSpace, KeepsToKnownFreeVoxelsWhereUnknownIsIgnored) {
  // An L of free voxels; the short way between its ends crosses the unknown.
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {9, 9, 0}, [](const VoxelIndex& v) {
    return v.x == 0 || v.y == 0 ? VoxelState::kFree : VoxelState::kUnknown;
  });
  const EsdfMap esdf = compute_esdf(map, {.unknown = UnknownPolicy::kIgnore});
  const FreeSpace space(esdf);
  EXPECT_TRUE(space.is_free(Point(0.05, 0.95, 0.05), Point(0.05, 0.05, 0.05), 0.3));
  EXPECT_FALSE(space.is_free(Point(0.05, 0.95, 0.05), Point(0.95, 0.05, 0.05), 0.3));
  EXPECT_FALSE(space.is_free(Point(0.5, 0.5, 0.05), 0.3));
  // Through the very corner that two free voxels share, past unknown ones.
  EXPECT_TRUE(space.is_free(Point(0.05, 0.15, 0.05), Point(0.15, 0.05, 0.05), 0.3));
}

/// Whether a segment of which no coordinate stays the same meets a cube.
bool meets(const Point& a, const Point& b, const Point& low, const Point& high) {
  const Eigen::Array3d one = (low - a).array() / (b - a).array();
  const Eigen::Array3d other = (high - a).array() / (b - a).array();
  return std::max(0.0, one.min(other).maxCoeff()) <= std::min(1.0, one.max(other).minCoeff());
}

/// Every voxel is held against segments, a little smaller and a little larger than it is. Many
/// segments cross blocks without an obstacle, and some begin on planes between blocks.
TEST(FreeSpace, ASegmentIsKnownFreeWhereItMeetsNoOtherVoxel) {
  std::array<int, 2> counts{};
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const OccupancyMap map =
        testing::make_map(1.0, {0, 0, 0}, {23, 23, 23}, [&](const VoxelIndex&) {
          const auto dice = random() % 4000;
          return dice < 5    ? VoxelState::kOccupied
                 : dice < 20 ? VoxelState::kUnknown
                             : VoxelState::kFree;
        });
    const UnknownPolicy policy = seed % 2 == 0 ? UnknownPolicy::kFree : UnknownPolicy::kIgnore;
    const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
    const FreeSpace space(esdf);
    const VoxelRange whole = {{0, 0, 0}, {23, 23, 23}};
    std::vector<VoxelIndex> closed;
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (const VoxelIndex v = esdf.layout.index_of(id); !esdf.is_open(id) && whole.contains(v))
        closed.push_back(v);
    std::uniform_real_distribution<double> inside(0.001, 23.999);
    for (int i = 0; i < 600; ++i) {
      Point a(inside(random), inside(random), inside(random));
      const Point b(inside(random), inside(random), inside(random));
      if (i % 2 == 0) a.x() = 8.0 + 1e-9 * (static_cast<double>(random() % 20) - 10.0);
      bool may = true, must = true;
      for (const VoxelIndex& v : closed) {
        const Point low(v.x, v.y, v.z), off = Point::Constant(1e-6);
        may &= !meets(a, b, low + off, low + Point::Ones() - off);
        must &= !meets(a, b, low - off, low + Point::Ones() + off);
      }
      if (may != must) continue;
      ASSERT_EQ(space.is_known_free(a, b), may) << a.transpose() << " to " << b.transpose();
      ++counts[may];
    }
  }
  EXPECT_GT(std::min(counts[0], counts[1]), 300);
}

/// Where unknown space is free, places on an upper face of the last blocks are of the map, too.
TEST(FreeSpace, ClearanceOnTheUpperFacesOfTheMapIsThatBesideThem) {
  const OccupancyMap map = testing::make_map(1.0, {0, 0, 0}, {23, 23, 23}, [](const VoxelIndex& v) {
    return v.x == 20 && v.y == 12 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const EsdfMap esdf = compute_esdf(map, {.unknown = UnknownPolicy::kFree});
  const FreeSpace space(esdf);
  const Point a(24, 2, 10), b(24, 22, 10);
  EXPECT_TRUE(space.is_free(a, b, 2.9));
  EXPECT_FALSE(space.is_free(a, b, 3.1));
  EXPECT_NEAR(space.clearance(a, b), 3.0, 1e-9);
  EXPECT_NEAR(space.distance({24, 12.5, 10}), 3.0, 1e-9);
}

TEST(FreeSpace, NothingIsFreeWhereNoVoxelIsNorForNoRadius) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {15, 15, 15}, [](const VoxelIndex& v) {
    return v.x == 9 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const Point here(0.25, 0.55, 0.55), wall(0.95, 0.55, 0.55);
  for (const auto policy :
       {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore, UnknownPolicy::kFree}) {
    const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
    const FreeSpace space(esdf);
    for (const double x : {2e8, 1e100, 1e154, 1e300, kInfinity, kNaN, -1e154}) {
      const Point far(x, 0.55, 0.55);
      EXPECT_FALSE(space.is_free(far, 0.1));
      for (const auto& [a, b] : {std::pair(here, far), std::pair(far, here)}) {
        EXPECT_FALSE(space.is_free(a, b, 0.1)) << x;
        EXPECT_FALSE(space.is_clearly_free(a, b, 0.1)) << x;
        EXPECT_FALSE(space.is_known_free(a, b)) << x;
        EXPECT_EQ(space.free_length(a, b, 0.1), 0.0) << x;
        EXPECT_EQ(space.clear_length(a, b, 0.1), 0.0) << x;
        EXPECT_EQ(space.clearance(a, b), 0.0) << x;
      }
      EXPECT_FALSE(space.near_obstacle(far));
    }
    EXPECT_TRUE(space.is_free(here, 0.1));
    for (const double radius : {kNaN, -1e-9, -1.0}) {
      EXPECT_FALSE(space.is_free(here, radius)) << radius;
      EXPECT_FALSE(space.is_free(wall, radius)) << radius;
      EXPECT_FALSE(space.is_clearly_free(here, here, radius)) << radius;
      EXPECT_EQ(space.free_length(here, wall, radius), 0.0) << radius;
      EXPECT_EQ(space.clear_length(here, wall, radius), 0.0) << radius;
    }
  }
}

}  // namespace
}  // namespace ridgeway
