// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/depth_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "random_worlds.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "sensing/poses.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway {
namespace {

/// A wall at x = 4, seen from the origin.
World wall() {
  World world;
  world.planes.push_back({-Eigen::Vector3d::UnitX(), -4.0});
  return world;
}

TEST(DepthCamera, SeesAWallAtOneDepthAndNothingBeyondItsRange) {
  const DepthSensor sensor;
  const DepthImage image = render_depth(wall(), sensor, level_pose(Point::Zero(), 0.0));
  ASSERT_EQ(image.depth.size(), 320u * 240u);
  for (const float depth : image.depth) EXPECT_NEAR(depth, 4.0, 1e-5);
  DepthSensor near = sensor;
  near.max_range = 4.5;  // the middle alone is so near along the ray
  const DepthImage part = render_depth(wall(), near, level_pose(Point::Zero(), 0.0));
  EXPECT_GT(part.at(160, 120), 0.0f);
  EXPECT_EQ(part.at(0, 0), 0.0f);
}

TEST(DepthCamera, PixelsArePointsOfTheWorld) {
  int worlds = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const World world = testing::random_world(seed);
    Random random(seed);
    const DepthSensor sensor{.camera = {64, 48, 32.0, 32.0, 31.5, 23.5}};
    const Eigen::Isometry3d pose = level_pose({-7.0, -7.0, 3.0}, random.uniform(0.0, 1.5));
    if (surface_distance(world, pose.translation()).distance < 0.1) continue;
    ++worlds;
    const DepthImage image = render_depth(world, sensor, pose);
    int seen = 0;
    for (int v = 0; v < 48; ++v)
      for (int u = 0; u < 64; ++u) {
        const float depth = image.at(u, v);
        if (depth == 0.0f) continue;
        const Point p = pose * Point(depth * sensor.camera.ray(u, v));
        ASSERT_NEAR(surface_distance(world, p).distance, 0.0, 1e-5);
        ++seen;
      }
    EXPECT_GT(seen, 0);
  }
  EXPECT_GT(worlds, 0);
}

TEST(SpinningLidar, BeamsEndOnTheWorldAllAroundWithinItsAngle) {
  const SpinningLidar lidar = {.rows = 9, .columns = 72, .vertical = 0.8, .max_range = 30.0};
  int worlds = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const World world = testing::random_world(seed);
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.3 * static_cast<double>(seed),
                                             Eigen::Vector3d(0.1, 0.2, 1.0).normalized()));
    pose.translation() = Point(-7.0, -7.0, 3.0);
    if (surface_distance(world, pose.translation()).distance < 0.1) continue;
    ++worlds;
    const std::vector<Point> points = scan_with(world, lidar, pose);
    EXPECT_LE(points.size(), 9u * 72u);
    EXPECT_GT(points.size(), 0u);
    double highest = -1.0, lowest = 1.0;
    for (const Point& p : points) {
      ASSERT_NEAR(surface_distance(world, pose * p).distance, 0.0, 1e-5);
      ASSERT_LE(p.norm(), lidar.max_range);
      const double rise = std::atan2(p.z(), p.head<2>().norm());
      highest = std::max(highest, rise);
      lowest = std::min(lowest, rise);
    }
    EXPECT_LE(highest, 0.4 + 1e-9);
    EXPECT_GE(lowest, -0.4 - 1e-9);
  }
  EXPECT_GT(worlds, 0);
}

TEST(SpinningLidar, SeesAWallOnOneSideWithNoiseThatTheSeedGives) {
  const SpinningLidar lidar = {.rows = 3, .columns = 8, .range_sigma = 0.02};
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto scan = [&](std::uint64_t seed, int threads) {
    return with_threads(threads, [&] { return scan_with(wall(), lidar, pose, seed); });
  };
  const std::vector<Point> points = scan(1, 1);
  EXPECT_EQ(points.size(), 9u);  // of each row the beam ahead and those 45 degrees beside it
  for (const Point& p : points) EXPECT_NEAR(p.x(), 4.0, 0.15);
  EXPECT_EQ(points, scan(1, 2));
  EXPECT_NE(points, scan(2, 1));
}

TEST(SpinningLidar, RefusesWhatIsNoLidar) {
  const auto refuses = [](SpinningLidar lidar) {
    EXPECT_THROW(scan_with(wall(), lidar, Eigen::Isometry3d::Identity()), InputError);
  };
  refuses({.rows = 1});
  refuses({.columns = 2});
  refuses({.vertical = 3.2});
  refuses({.min_range = 11.0});
  refuses({.range_sigma = -1.0});
  refuses({.max_range = std::numeric_limits<double>::quiet_NaN()});
}

TEST(DepthCamera, LevelPosesLookWhereTheySay) {
  const Eigen::Isometry3d pose = level_pose({1.0, 2.0, 3.0}, std::numbers::pi / 2);
  EXPECT_NEAR((pose.linear() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm(), 0.0,
              1e-12);
  EXPECT_NEAR((pose.linear() * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 0.0,
              1e-12);
  EXPECT_NEAR(pose.linear().determinant(), 1.0, 1e-12);
}

TEST(DepthCamera, NoiseIsGaussianAlongTheRay) {
  DepthSensor sensor;
  sensor.range_sigma = 0.2;
  const DepthImage image = render_depth(wall(), sensor, level_pose(Point::Zero(), 0.0), 5);
  double sum = 0.0, squares = 0.0, beyond = 0.0;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const double off = (image.at(u, v) - 4.0) * sensor.camera.ray(u, v).norm();
      sum += off;
      squares += off * off;
      beyond += std::abs(off) > 0.4;
    }
  const double count = 320.0 * 240.0;
  EXPECT_NEAR(sum / count, 0.0, 0.003);
  EXPECT_NEAR(std::sqrt(squares / count), 0.2, 0.003);
  EXPECT_NEAR(beyond / count, 0.0455, 0.005);
}

TEST(DepthCamera, StereoNoiseGrowsWithTheSquareOfDepth) {
  const auto spread_at = [](double x) {
    World world;
    world.planes.push_back({-Eigen::Vector3d::UnitX(), -x});
    DepthSensor sensor = stereo_sensor();
    sensor.max_range = 20.0;
    const DepthImage image = render_depth(world, sensor, level_pose(Point::Zero(), 0.0), 5);
    double squares = 0.0, count = 0.0;
    for (int v = 0; v < 240; ++v)
      for (int u = 40; u < 320; ++u) {
        squares += std::pow(image.at(u, v) - x, 2);
        ++count;
      }
    return std::sqrt(squares / count);
  };
  EXPECT_NEAR(spread_at(4.0) / spread_at(2.0), 4.0, 0.2);
  // The strip at the left that the right camera does not see, and what is too near.
  const DepthImage image = render_depth(wall(), stereo_sensor(), level_pose(Point::Zero(), 0.0));
  EXPECT_EQ(image.at(2, 100), 0.0f);
  EXPECT_GT(image.at(6, 100), 0.0f);
  const DepthImage close = render_depth(wall(), stereo_sensor(), level_pose({3.8, 0, 0}, 0.0));
  EXPECT_EQ(close.at(160, 120), 0.0f);
}

TEST(DepthCamera, ImagesDoNotDependOnThreads) {
  DepthSensor sensor;
  sensor.range_sigma = 0.1;
  const auto render = [&](int threads, std::uint64_t seed) {
    return with_threads(threads, [&] {
      return render_depth(wall(), sensor, level_pose(Point::Zero(), 0.3), seed).depth;
    });
  };
  EXPECT_EQ(render(1, 3), render(2, 3));
  EXPECT_NE(render(1, 3), render(1, 4));
}

TEST(DepthCamera, BadSensorsAreRefused) {
  const auto refused = [](const auto& spoil) {
    DepthSensor sensor;
    spoil(sensor);
    EXPECT_THROW(render_depth(wall(), sensor, Eigen::Isometry3d::Identity()), InputError);
  };
  refused([](DepthSensor& s) { s.camera.width = 0; });
  refused([](DepthSensor& s) { s.camera.fx = -1.0; });
  refused([](DepthSensor& s) { s.camera.cx = 400.0; });
  refused([](DepthSensor& s) { s.max_range = 0.0; });
  refused([](DepthSensor& s) { s.range_sigma = std::nan(""); });
  refused([](DepthSensor& s) { s.baseline = -1.0; });
}

TEST(Poses, KeepTheirDistanceAndRepeat) {
  const World world = testing::random_world(2);
  const PoseSampling sampling{.low = {-5, -5, -3}, .high = {5, 5, 5}, .count = 100, .seed = 4};
  const auto poses = sample_poses(world, sampling);
  ASSERT_EQ(poses.size(), 100u);
  for (const Eigen::Isometry3d& pose : poses) {
    EXPECT_GE(surface_distance(world, pose.translation()).distance, 0.5);
    EXPECT_NEAR(pose.linear()(2, 1), -1.0, 1e-12);  // down is down
  }
  EXPECT_EQ(poses[7].matrix(), sample_poses(world, sampling)[7].matrix());
  EXPECT_THROW(sample_poses(world, {.low = {-5, -5, -20}, .high = {5, 5, -15}}), InputError);

  const PoseSampling inside = sampling_inside(make_maze({.cells = 4}));
  EXPECT_EQ(inside.low, Point::Zero());
  EXPECT_EQ(inside.high, Point(12.0, 12.0, 2.5));
  EXPECT_THROW(sampling_inside(World{}), InputError);
  // A room turned by 30 degrees, whose floor tilts, is where its corners are.
  World room;
  const double c = std::cos(0.5235987755982988), s = 0.5;
  for (const auto& [x, y] :
       {std::pair(c, s), std::pair(-c, -s), std::pair(-s, c), std::pair(s, -c)})
    room.planes.push_back({{x, y, 0.0}, -2.0});
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();
  room.planes.push_back({up, 0.0});
  room.planes.push_back({-Eigen::Vector3d::UnitZ(), -3.0});
  const PoseSampling turned = sampling_inside(room);
  const double far = 2.0 * (c + s);
  EXPECT_LT((turned.low - Point(-far, -far, -0.1 * far)).norm(), 1e-9) << turned.low.transpose();
  EXPECT_LT((turned.high - Point(far, far, 3.0)).norm(), 1e-9) << turned.high.transpose();
  room.planes.pop_back();  // without a ceiling there is no end above
  EXPECT_THROW(sampling_inside(room), InputError);
  room.spheres.push_back({{0.0, 0.0, 1.0}, 0.25});
  EXPECT_EQ(sampling_inside(room).high.z(), 1.25);
}

}  // namespace
}  // namespace ridgeway
