// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/distance_field.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "support/brute_force.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

TEST(SignedDistance, IsExactInsideObstaclesToo) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const OccupancyMap map = testing::random_map(seed, 16);
    for (const auto policy : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore}) {
      const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
      std::vector<VoxelIndex> open;  // what is no obstacle
      for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
        if (!esdf.obstacle.test(id)) open.push_back(esdf.layout.index_of(id));
      for (VoxelId id = seed; id < esdf.layout.voxel_count(); id += 37) {
        const VoxelIndex v = esdf.layout.index_of(id);
        const double signed_value = signed_distance(esdf, v, 0.6);
        if (!esdf.obstacle.test(id)) {
          if (esdf.squared[id] != kNoSite) {
            ASSERT_EQ(signed_value, esdf.distance(id));
          }
          continue;
        }
        const double brute = 0.1 * std::sqrt(testing::brute_squared_distance(
                                       Eigen::Vector3d(v.x + 0.5, v.y + 0.5, v.z + 0.5), open));
        // Where unknown is ignored, space that is not allocated is open as well and may be nearer.
        if (policy == UnknownPolicy::kObstacle) {
          ASSERT_NEAR(signed_value, -std::min(brute, 0.6), 1e-9);
        } else {
          ASSERT_GE(signed_value, -std::min(brute, 0.6) - 1e-9);
        }
      }
    }
  }
}

TEST(Interpolation, MeetsTheVoxelsAndItsGradientIsTheSlope) {
  const EsdfMap esdf = compute_esdf(testing::random_map(4), {});
  std::mt19937 random(4);
  std::uniform_real_distribution<double> inside(0.05, 0.95);
  int checked = 0;
  for (int i = 0; i < 4000; ++i) {
    const VoxelId id = static_cast<VoxelId>(random() % esdf.layout.voxel_count());
    const VoxelIndex v = esdf.layout.index_of(id);
    const Point centre = centre_of(v, esdf.voxel_size);
    ASSERT_NEAR(interpolate_distance(esdf, centre).distance, signed_distance(esdf, v), 1e-9);
    const Point p = centre + Point(inside(random), inside(random), inside(random)) * 0.1;
    const DistanceAndGradient at = interpolate_distance(esdf, p);
    for (int axis = 0; axis < 3; ++axis) {
      Point step = Point::Zero();
      step[axis] = 1e-6;
      const double slope = (interpolate_distance(esdf, p + step).distance -
                            interpolate_distance(esdf, p - step).distance) /
                           2e-6;
      ASSERT_NEAR(at.gradient[axis], slope, 1e-6);
    }
    ++checked;
  }
  EXPECT_EQ(checked, 4000);
}

TEST(DistanceAt, AnswersPlacesOfTheWorldThatWereSeen) {
  constexpr VoxelIndex kFarAway{4650000, 53000000, 0};
  const OccupancyMap map = testing::random_map(6);
  OccupancyMap moved = map;
  moved.origin = moved.origin + kFarAway;
  const EsdfMap esdf = compute_esdf(map, {}), far = compute_esdf(moved, {});
  int seen = 0, unseen = 0;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); id += 7) {
    const Point centre = centre_of(esdf.layout.index_of(id), esdf.voxel_size);
    const auto near = distance_at(esdf, to_world(esdf, centre));
    const auto there = distance_at(far, to_world(far, centre));
    ASSERT_EQ(near.has_value(), esdf.state[id] != VoxelState::kUnknown);
    ASSERT_EQ(there.has_value(), near.has_value());
    ++(near ? seen : unseen);
    if (!near) continue;
    EXPECT_EQ(near->distance, interpolate_distance(esdf, centre).distance);
    EXPECT_EQ(there->distance, near->distance);
    EXPECT_EQ(there->gradient, near->gradient);
  }
  EXPECT_GT(seen, 50);
  EXPECT_GT(unseen, 50);
  EXPECT_FALSE(distance_at(esdf, Point(1e300, 0.0, 0.0)));
  EXPECT_FALSE(distance_at(esdf, Point(std::nan(""), 0.0, 0.0)));
}

// Beside the map's blocks no field says how far obstacles are, where unknown space is none.
TEST(SignedDistance, IsMeasuredBesideTheMap) {
  int checked = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    for (const auto policy : {UnknownPolicy::kIgnore, UnknownPolicy::kFree}) {
      const EsdfMap esdf = compute_esdf(testing::random_map(seed, 16), {.unknown = policy});
      std::vector<VoxelIndex> obstacles;
      for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
        if (esdf.obstacle.test(id)) obstacles.push_back(esdf.layout.index_of(id));
      for (VoxelId id = 0; id < esdf.layout.voxel_count(); id += 5)
        for (int d = 0; d < 27; ++d) {
          const VoxelIndex beside = esdf.layout.index_of(id) + offset_of(d);
          if (esdf.layout.find(beside) != kNoVoxel || esdf.squared[id] == kNoSite) continue;
          const double brute =
              std::sqrt(testing::brute_squared_distance(centre_of(beside, 1.0), obstacles));
          ASSERT_NEAR(signed_distance(esdf, beside), esdf.voxel_size * brute, 1e-9);
          ++checked;
        }
    }
  }
  EXPECT_GT(checked, 1000);
}

/// Where distances end, what is measured beside the map is no farther than it is.
TEST(SignedDistance, BesideTheMapIsNoLongerThanItIsWhereDistancesEnd) {
  OccupancyMap map;
  map.voxel_size = 1.0;
  map.layout = BlockLayout({{0, 0, 0}, {4, 0, 0}});
  map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
  map.state[map.layout.find({32, 3, 3})] = VoxelState::kOccupied;
  for (const double max_distance : {14.0, 16.0, 17.0, 18.0}) {
    const EsdfMap esdf =
        compute_esdf(map, {.unknown = UnknownPolicy::kIgnore, .max_distance = max_distance});
    EXPECT_NEAR(signed_distance(esdf, {16, 3, 3}), std::min(15.5, max_distance), 1e-9)
        << max_distance;
  }
}

TEST(Interpolation, PlacesThatAreNoneAreRefused) {
  OccupancyMap map;
  map.voxel_size = 1.0;
  map.layout = BlockLayout({{0, 0, 0}});
  map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
  const EsdfMap esdf = compute_esdf(map);
  for (const double x : {std::nan(""), 3e9, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(interpolate_distance(esdf, {x, 1.0, 1.0}), InputError) << x;
  EXPECT_THROW(signed_distance(esdf, {std::numeric_limits<int>::max(), 0, 0}), InputError);
}

TEST(DistanceAt, IsInfiniteWhereThereIsNoObstacle) {
  const EsdfMap esdf =
      compute_esdf(testing::make_map(0.1, {0, 0, 0}, {15, 15, 15},
                                     [](const VoxelIndex&) { return VoxelState::kFree; }),
                   {.unknown = UnknownPolicy::kFree});
  for (const Point& p : {Point(0.5, 0.5, 0.5), Point(0.01, 0.8, 1.59)}) {
    const auto found = distance_at(esdf, p);
    ASSERT_TRUE(found);
    EXPECT_TRUE(std::isinf(found->distance));
    EXPECT_EQ(found->gradient, Point::Zero());
  }
}

TEST(SignedDistance, ADepthThatIsNoneIsRefused) {
  const EsdfMap esdf = compute_esdf(testing::make_map(
      0.1, {0, 0, 0}, {7, 7, 7}, [](const VoxelIndex&) { return VoxelState::kOccupied; }));
  EXPECT_EQ(signed_distance(esdf, {3, 3, 3}, 0.0), 0.0);
  EXPECT_EQ(signed_distance(esdf, {3, 3, 3}, 2.0), -2.0);
  for (const double deepest :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(signed_distance(esdf, {3, 3, 3}, deepest), InputError);
    EXPECT_THROW(interpolate_distance(esdf, {0.4, 0.4, 0.4}, deepest), InputError);
    EXPECT_THROW(distance_at(esdf, {0.4, 0.4, 0.4}, deepest), InputError);
  }
}

TEST(DistanceAt, InAPlaneHeightsPlayNoPart) {
  const OccupancyMap room = testing::make_map(0.1, {0, 0, 0}, {31, 31, 9}, [](const VoxelIndex& v) {
    return v.x == 0 || v.y == 31 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const EsdfMap esdf = compute_esdf(flatten(room, 0.2, 0.6));
  const auto expected = distance_at(esdf, {1.03, 1.0, 0.4});
  ASSERT_TRUE(expected);
  EXPECT_NEAR(expected->distance, 0.93, 1e-6);
  for (const double z : {-100.0, 0.0, 0.3, 0.81, 7.0}) {
    const auto found = distance_at(esdf, {1.03, 1.0, z});
    ASSERT_TRUE(found) << z;
    EXPECT_EQ(found->distance, expected->distance) << z;
    EXPECT_EQ(found->gradient.z(), 0.0) << z;
  }
}

}  // namespace
}  // namespace ridgeway
