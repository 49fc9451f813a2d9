// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/tsdf_fusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "sensing/poses.hpp"
#include "support/lattice.hpp"
#include "support/map_errors.hpp"

namespace ridgeway {
namespace {

World house() { return load_world(std::string(RIDGEWAY_WORLDS_DIR) + "/house.yaml"); }

std::vector<Eigen::Isometry3d> poses_in_house(std::size_t count) {
  return sample_poses(house(), {.low = {1, 1, 1}, .high = {14, 10, 5}, .count = count, .seed = 1});
}

TsdfMap fuse_house(const FusionConfig& config, std::size_t count, double sigma = 0.0) {
  const World world = house();
  DepthSensor sensor;
  sensor.range_sigma = sigma;
  TsdfFusion fusion(config);
  std::uint64_t seed = 0;
  for (const Eigen::Isometry3d& pose : poses_in_house(count))
    fusion.integrate(render_depth(world, sensor, pose, seed++), sensor.camera, pose);
  return fusion.map();
}

TEST(TsdfFusion, HouseWithoutNoiseIsThatOfTheExactDistance) {
  const MapErrors errors = errors_of(fuse_house({.truncation = 0.4}, 200), house());
  EXPECT_GT(errors.voxels, 300000u);
  EXPECT_LE(errors.mean, 0.1);
  EXPECT_LT(errors.p99, 1.001);
}

TEST(TsdfFusion, HouseByRaysIsNearlyAsGood) {
  const FusionConfig config{.truncation = 0.4, .integrator = Integrator::kRayCasting};
  const MapErrors errors = errors_of(fuse_house(config, 200), house());
  EXPECT_GT(errors.voxels, 300000u);
  EXPECT_LE(errors.mean, 0.25);
  EXPECT_LE(errors.p99, 1.5);
}

TEST(TsdfFusion, AWallIsWhereItIsAtAnySlant) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.03});
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting})
    for (const double heading : {0.0, 0.5, 1.0, -1.2}) {
      const DepthSensor sensor;
      TsdfFusion fusion({.integrator = integrator});
      const Eigen::Isometry3d pose = level_pose(Point::Zero(), heading);
      fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
      const MapErrors errors = errors_of(fusion.map(), world);
      EXPECT_GT(errors.voxels, 5000u);
      EXPECT_LT(errors.mean, 0.02) << heading;
      EXPECT_LT(errors.p99, 0.2) << heading;
    }
}

TEST(TsdfFusion, SpaceBeforeAWallIsFreeAndBehindItUnknown) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.0});
  const DepthSensor sensor;
  const Eigen::Isometry3d pose = level_pose({0.05, 0.05, 0.05}, 0.0);
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting})
    for (const bool carve : {true, false}) {
      TsdfFusion fusion({.carve = carve, .integrator = integrator});
      fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
      const OccupancyMap map = occupancy_of(fusion.map());
      for (int x = 5; x < 50; ++x) {
        if (x == 41 || x == 42) continue;  // solid as far as is taken for granted, or unknown
        const VoxelState expected = x > 42             ? VoxelState::kUnknown
                                    : x == 40          ? VoxelState::kOccupied
                                    : x >= 36 || carve ? VoxelState::kFree
                                                       : VoxelState::kUnknown;
        EXPECT_EQ(testing::state_at(map, {x, 0, 0}), expected) << x;
      }
    }
}

TEST(TsdfFusion, BitsDoNotDependOnThreads) {
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting}) {
    const auto fuse = [&](int threads) {
      return with_threads(threads, [&] { return fuse_house({.integrator = integrator}, 10, 0.1); });
    };
    const TsdfMap one = fuse(1), two = fuse(2);
    EXPECT_TRUE(one.layout == two.layout);
    EXPECT_TRUE(one.distance.values() == two.distance.values());
    EXPECT_TRUE(one.weight.values() == two.weight.values());
  }
}

TEST(TsdfFusion, PointCloudsWorkLikeTheirImages) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.0});
  const DepthSensor sensor;
  const Eigen::Isometry3d pose = level_pose(Point::Zero(), 0.0);
  const DepthImage image = render_depth(world, sensor, pose);
  std::vector<Point> points = {Point::Constant(std::nan("")), Point::Zero(),
                               Point::Constant(1e300)};
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      points.emplace_back(image.at(u, v) * sensor.camera.ray(u, v));
  TsdfFusion fusion;
  fusion.integrate(points, pose);
  const OccupancyMap map = occupancy_of(fusion.map());
  EXPECT_EQ(testing::state_at(map, {20, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(testing::state_at(map, {40, 0, 0}), VoxelState::kOccupied);
  EXPECT_EQ(testing::state_at(map, {45, 0, 0}), VoxelState::kUnknown);
}

TEST(TsdfFusion, DistancesStayWithinTheTruncationHoweverOftenSpaceIsSeen) {
  Random random(3);
  TsdfFusion fusion;
  for (int scan = 0; scan < 10; ++scan) {  // thousands of rays through the sensor's own voxel
    std::vector<Point> points(10000);
    for (Point& point : points)
      point = 2.0 * Point(random.normal(), random.normal(), random.normal()).normalized();
    fusion.integrate(points, level_pose({0.01, 0.02, 0.03}, 0.1 * scan));
  }
  const TsdfMap map = fusion.map();
  for (const float distance : map.distance.values())
    ASSERT_LE(std::abs(distance), map.truncation * (1.0 + 1e-6));
}

TEST(TsdfFusion, WhereTheRobotWasIsFree) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.0});
  DepthSensor sensor;
  sensor.min_range = 3.0;
  const Eigen::Isometry3d pose = level_pose({0.05, 0.05, 0.05}, 0.0);
  TsdfFusion fusion({.clear_radius = 0.3});
  fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
  const OccupancyMap map = occupancy_of(fusion.map());
  EXPECT_EQ(testing::state_at(map, {0, 2, 0}), VoxelState::kFree);
  EXPECT_EQ(testing::state_at(map, {-2, 0, 0}), VoxelState::kFree);
  EXPECT_EQ(testing::state_at(map, {-5, 0, 0}), VoxelState::kUnknown);
}

TEST(TsdfFusion, WhatWasMeasuredNearTheRobotStays) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -2.0});
  const DepthSensor sensor;
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting}) {
    TsdfFusion fusion({.clear_radius = 0.8, .integrator = integrator});
    for (const double x : {0.0, 1.5, 1.7}) {  // towards the wall, then off it
      const Eigen::Isometry3d pose = level_pose({x, 0.05, 0.05}, x > 1.6 ? std::numbers::pi : 0.0);
      fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
    }
    const OccupancyMap map = occupancy_of(fusion.map());
    EXPECT_EQ(testing::state_at(map, {17, 0, 7}), VoxelState::kFree);  // which no image saw
    for (const int y : {-2, 0, 2})
      EXPECT_EQ(testing::state_at(map, {20, y, 0}), VoxelState::kOccupied) << y;
  }
}

TEST(TsdfFusion, WhatWouldSpoilTheMapIsRefused) {
  const DepthSensor sensor;
  const Eigen::Isometry3d level = level_pose(Point::Zero(), 0.0);
  const DepthImage image = render_depth(house(), sensor, level_pose({1, 1, 1}, 0.0));
  TsdfFusion fusion;
  DepthImage small = image;
  small.depth.pop_back();
  EXPECT_THROW(fusion.integrate(small, sensor.camera, level), InputError);
  PinholeCamera other = sensor.camera;
  other.width = 640;
  EXPECT_THROW(fusion.integrate(image, other, level), InputError);
  Eigen::Isometry3d skewed = level;
  skewed.linear() *= 1.1;
  EXPECT_THROW(fusion.integrate(image, sensor.camera, skewed), InputError);
  DepthImage odd = image;  // a sensor's odd values are no measurements
  odd.depth[0] = std::nanf("");
  odd.depth[1] = -1.0f;
  odd.depth[2] = std::numeric_limits<float>::infinity();
  EXPECT_NO_THROW(fusion.integrate(odd, sensor.camera, level));
  const TsdfMap map = fusion.map();
  for (const float distance : map.distance.values()) ASSERT_TRUE(std::isfinite(distance));
  EXPECT_THROW(TsdfFusion({.voxel_size = 0.0}), InputError);
  EXPECT_THROW(TsdfFusion({.voxel_size = 0.1, .truncation = 0.05}), InputError);
  EXPECT_THROW(TsdfFusion({.min_range = 3.0, .max_range = 2.0}), InputError);
}

TEST(TsdfFusion, APoseWhoseMeasurementsAreRefusedLeavesNoTrace) {
  const DepthSensor sensor;
  const Eigen::Isometry3d refused = level_pose({1, 1, 1}, 0.0), taken = level_pose({5, 5, 1}, 0.0);
  const DepthImage image = render_depth(house(), sensor, refused);
  const std::vector<Point> points = {{0.3, 0.0, 0.2}};
  // An image reaches over more blocks of this size than there may be; a point does not.
  const FusionConfig config{.voxel_size = 1e-3, .clear_radius = 0.02};
  TsdfFusion fusion(config), without(config);
  EXPECT_THROW(fusion.integrate(image, sensor.camera, refused), InputError);
  fusion.integrate(points, taken);
  without.integrate(points, taken);
  const TsdfMap map = fusion.map(), expected = without.map();
  EXPECT_EQ(map.layout, expected.layout);
  EXPECT_TRUE(std::ranges::equal(map.weight.values(), expected.weight.values()));
  EXPECT_EQ(map.layout.find(voxel_at(refused.translation(), config.voxel_size)), kNoVoxel);
}

TEST(TsdfFusion, VoxelsAndPosesThatNoMapHoldsAreRefused) {
  for (const double size : {1e-300, 1e-9, 1e-8, 11.0, 1e9, 1e300, std::nan("")})
    EXPECT_THROW(TsdfFusion({.voxel_size = size}), InputError) << size;
  EXPECT_THROW(TsdfFusion({.truncation = 1e300}), InputError);
  EXPECT_THROW(TsdfFusion({.depth_behind = 1e300}), InputError);
  EXPECT_THROW(TsdfFusion({.max_range = 1e300}), InputError);
  const DepthSensor sensor;
  const DepthImage image = render_depth(house(), sensor, level_pose({1, 1, 1}, 0.0));
  const std::vector<Point> points = {{1.0, 2.0, 9.0}};
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting}) {
    TsdfFusion fusion({.integrator = integrator});
    for (const double far : {1e8, -1e8, 1e9, 1e300, -1e300, std::nan("")}) {
      const Eigen::Isometry3d pose = level_pose({0.0, far, 0.0}, 0.3);
      EXPECT_THROW(fusion.integrate(image, sensor.camera, pose), InputError) << far;
      EXPECT_THROW(fusion.integrate(points, pose), InputError) << far;
    }
    EXPECT_NO_THROW(fusion.integrate(points, level_pose({0.0, 9.9e7, 0.0}, 0.3)));
    EXPECT_THROW(fusion.integrate(points, level_pose({0.0, 4.8e7, 0.0}, 0.3)), InputError);
    EXPECT_NO_THROW(fusion.integrate(points, level_pose({0.0, 5e7, 0.0}, 0.3)));
    TsdfFusion fine({.voxel_size = 1e-5, .integrator = integrator});  // room for no block of it
    EXPECT_THROW(fine.integrate(image, sensor.camera, level_pose(Point::Zero(), 0.0)), InputError);
    TsdfFusion cleared({.voxel_size = 1e-6, .clear_radius = 10.0, .integrator = integrator});
    EXPECT_THROW(cleared.integrate(points, level_pose(Point::Zero(), 0.0)), InputError);
  }
  for (const double focal : {1e-300, 1e-3, 1e300, 0.0, -160.0, std::nan("")}) {
    PinholeCamera camera = sensor.camera;
    camera.fx = focal;
    TsdfFusion fusion;
    EXPECT_THROW(fusion.integrate(image, camera, level_pose(Point::Zero(), 0.0)), InputError);
  }
}

TEST(TsdfFusion, ImagesOfOneRowOrColumnAreFused) {
  for (const auto& [width, height] : {std::pair(320, 1), std::pair(1, 240)}) {
    const PinholeCamera camera{width, height, 160.0, 160.0, 0.5 * (width - 1), 0.5 * (height - 1)};
    DepthImage image{width, height,
                     std::vector<float>(static_cast<std::size_t>(width * height), 2.0f)};
    TsdfFusion fusion{{}};
    fusion.integrate(image, camera, Eigen::Isometry3d::Identity());
    EXPECT_GT(count_voxels(occupancy_of(fusion.map())).known(), 0u) << width << " x " << height;
  }
}

/// A pillar that no ray meets: pixels are 1.5 m apart there.
TEST(TsdfFusion, WhatLiesBetweenSparseRaysIsNotFree) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -9.0});
  world.boxes.push_back({.centre = {6.0, 0.0, 0.0}, .size = {1.0, 1.0, 18.0}});
  const DepthSensor sensor{
      .camera = {.width = 8, .height = 6, .fx = 4.0, .fy = 4.0, .cx = 3.5, .cy = 2.5}};
  TsdfFusion fusion({.max_range = 20.0});
  const Eigen::Isometry3d pose = level_pose(Point::Zero(), 0.0);
  fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
  const OccupancyMap map = occupancy_of(fusion.map());
  for (const double depth : {2.0, 5.0, 6.0, 8.0})
    EXPECT_EQ(testing::state_at(map, voxel_at(pose * Point(depth * sensor.camera.ray(4, 3)), 0.1)),
              VoxelState::kFree);
  for (int y = -4; y < 4; ++y)
    EXPECT_NE(testing::state_at(map, {60, y, 0}), VoxelState::kFree) << y;
}

/// The states of voxels straight ahead of a camera at 0.05 m.
std::vector<VoxelState> states_ahead(const FusionConfig& config, const DepthImage& image,
                                     const PinholeCamera& camera) {
  const Eigen::Isometry3d pose = level_pose({0.05, 0.05, 0.05}, 0.0);
  TsdfFusion fusion(config);
  fusion.integrate(image, camera, pose);
  const OccupancyMap map = occupancy_of(fusion.map());
  std::vector<VoxelState> states(60);
  for (std::size_t x = 0; x < states.size(); ++x)
    states[x] = testing::state_at(map, {static_cast<int>(x), 0, 0});
  return states;
}

TEST(TsdfFusion, WhatIsBeyondTheRangeFreesTheWayUpToIt) {
  const PinholeCamera camera;
  const auto pixels = static_cast<std::size_t>(camera.width * camera.height);
  for (const Integrator integrator : {Integrator::kProjective, Integrator::kRayCasting})
    for (const float depth : {3.001f, 3.05f, 4.5f, 40.0f, 2000.0f, 3e38f})
      for (const bool carve : {true, false}) {
        const DepthImage image{camera.width, camera.height, std::vector<float>(pixels, depth)};
        const std::vector<VoxelState> states = states_ahead(
            {.max_range = 3.0, .carve = carve, .integrator = integrator}, image, camera);
        for (std::size_t x = 5; x < states.size(); ++x) {
          if (x == 30) continue;  // the range ends at its centre
          const bool is_free =
              carve && x < 30 && depth < 60.0f;  // else in another unit than metres
          EXPECT_EQ(states[x], is_free ? VoxelState::kFree : VoxelState::kUnknown)
              << x << " of " << depth;
        }
      }
}

TEST(TsdfFusion, ALonePixelBeyondTheRangeFreesNothing) {
  const PinholeCamera camera;
  DepthImage image{camera.width, camera.height,
                   std::vector<float>(static_cast<std::size_t>(camera.width * camera.height))};
  image.depth[static_cast<std::size_t>((camera.height / 2) * camera.width + camera.width / 2)] =
      9.0f;
  const std::vector<VoxelState> states = states_ahead({.max_range = 3.0}, image, camera);
  EXPECT_EQ(std::count(states.begin(), states.end(), VoxelState::kUnknown), 60);
}

/// A pole half a voxel thick, before what is beyond the range.
TEST(TsdfFusion, WhatIsBeyondTheRangeDoesNotFreeThinThings) {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -9.0});
  for (int i = 0; i < 10; ++i) {
    const double x = 2.0 + 0.053 * i, y = -1.0 + 0.217 * i;
    world.boxes.push_back({.centre = {x, y, 0.0}, .size = {0.05, 0.05, 18.0}});
  }
  const DepthSensor sensor;
  TsdfFusion fusion({.max_range = 4.0});
  const Eigen::Isometry3d pose = level_pose(Point::Zero(), 0.0);
  for (int look = 0; look < 20; ++look)
    fusion.integrate(render_depth(world, sensor, pose), sensor.camera, pose);
  const OccupancyMap map = occupancy_of(fusion.map());
  for (const SolidBox& pole : world.boxes) {
    const VoxelIndex low = voxel_at(pole.centre - 0.5 * pole.size, 0.1),
                     high = voxel_at(pole.centre + 0.5 * pole.size, 0.1);
    bool is_seen = false;  // up to a voxel behind its front
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x + 1; ++x)
        is_seen |= testing::state_at(map, {x, y, 0}) == VoxelState::kOccupied;
    EXPECT_TRUE(is_seen) << pole.centre.y();
  }
}

TEST(TsdfFusion, PointsBeyondTheRangeFreeTheWayUpToIt) {
  const std::vector<Point> points = {{9.0, 0.0, 0.0}, {0.0, 59.0, 0.0}, {0.0, 0.0, -1e300}};
  TsdfFusion fusion({.max_range = 3.0});
  fusion.integrate(points, Eigen::Isometry3d(Eigen::Translation3d(0.05, 0.05, 0.05)));
  const OccupancyMap map = occupancy_of(fusion.map());
  EXPECT_EQ(count_voxels(map).occupied, 0u);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(testing::state_at(map, {i, 0, 0}), VoxelState::kFree) << i;
  EXPECT_EQ(testing::state_at(map, {0, 29, 0}), VoxelState::kFree);
  EXPECT_EQ(testing::state_at(map, {31, 0, 0}), VoxelState::kUnknown);
  EXPECT_EQ(testing::state_at(map, {0, 0, -9}), VoxelState::kUnknown);
}

/// What is nearer than any sensor measures must not leave what is no number.
TEST(TsdfFusion, RangesOfNothingAreNone) {
  TsdfFusion fusion({.min_range = 0.0});
  const std::vector<Point> points = {{1e-25, 0.0, 0.0}, {0.0, 1e-12, 0.0}, {2.0, 0.0, 0.0}};
  for (int look = 0; look < 3; ++look) fusion.integrate(points, Eigen::Isometry3d::Identity());
  const TsdfMap map = fusion.map();
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    ASSERT_LE(std::abs(map.distance[id]), static_cast<float>(map.truncation));
}

TEST(TsdfFusion, ImagesWithoutAllTheirDepthsAreCalledSo) {
  TsdfFusion fusion({.voxel_size = 0.1});
  const PinholeCamera camera{8, 6, 4.0, 4.0, 3.5, 2.5};
  try {
    fusion.integrate(DepthImage{8, 6, std::vector<float>(10)}, camera,
                     Eigen::Isometry3d::Identity());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("has 10 depths, not 48"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace ridgeway
