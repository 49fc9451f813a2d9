// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sensing/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "random_worlds.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using testing::random_direction;
using testing::random_vector;
using testing::random_world;

/// Steps along a ray by the distance to the nearest surface: finds what cast_ray does without
/// knowing any shape. Infinite beyond `longest`.
double sphere_trace(const World& world, const Point& origin, const Eigen::Vector3d& direction,
                    double longest) {
  double range = 0.0;
  while (range < longest) {
    const double distance = surface_distance(world, origin + range * direction).distance;
    if (distance < 1e-9) return range;
    range += distance;
  }
  return std::numeric_limits<double>::infinity();
}

TEST(World, DistanceIsThatOfTheNearestSurfacePoint) {
  int outside = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const World world = random_world(seed);
    Random random(seed);
    for (int i = 0; i < 40; ++i) {
      const Point p = random_vector(random, -6.0, 6.0);
      const SurfaceDistance here = surface_distance(world, p);
      ASSERT_NEAR(here.gradient.norm(), 1.0, 1e-12);
      if (here.distance <= 0.0) continue;
      ++outside;
      // The foot is on the surface, and no ray meets a surface nearer.
      const Point foot = p - here.distance * here.gradient;
      ASSERT_NEAR(surface_distance(world, foot).distance, 0.0, 1e-9);
      for (int k = 0; k < 20; ++k)
        ASSERT_GE(cast_ray(world, p, random_direction(random)), here.distance - 1e-9);
    }
  }
  EXPECT_GT(outside, 1000);
}

TEST(World, DepthInsideASingleSolidIsThatToItsSurface) {
  World world;
  world.boxes.push_back({{1.0, 2.0, 3.0}, {2.0, 4.0, 6.0}});
  EXPECT_NEAR(surface_distance(world, {1.7, 2.0, 3.0}).distance, -0.3, 1e-12);
  EXPECT_EQ(surface_distance(world, {1.7, 2.0, 3.0}).gradient, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(surface_distance(world, {1.0, 0.1, 3.0}).distance, -0.1, 1e-12);
  World round;
  round.cylinders.push_back({Point::Zero(), 1.0, 4.0});
  EXPECT_NEAR(surface_distance(round, {0.0, 0.6, 0.0}).distance, -0.4, 1e-12);
  EXPECT_NEAR(surface_distance(round, {0.0, 0.6, -1.9}).distance, -0.1, 1e-12);
  EXPECT_NEAR(surface_distance(round, {0.0, 4.0, 6.0}).distance, 5.0, 1e-12);
  round.spheres.push_back({{10.0, 0.0, 0.0}, 1.0});
  EXPECT_NEAR(surface_distance(round, {9.5, 0.0, 0.0}).distance, -0.5, 1e-12);
}

TEST(World, GradientIsTheSlopeOfTheDistance) {
  constexpr double kStep = 1e-6;
  int smooth = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const World world = random_world(seed);
    Random random(seed);
    for (int i = 0; i < 40; ++i) {
      const Point p = random_vector(random, -6.0, 6.0);
      Eigen::Vector3d slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
        slope[axis] = (surface_distance(world, p + step).distance -
                       surface_distance(world, p - step).distance) /
                      (2.0 * kStep);
      }
      if (std::abs(slope.norm() - 1.0) > 1e-6) continue;  // a ridge runs through here
      ++smooth;
      ASSERT_LT((slope - surface_distance(world, p).gradient).norm(), 1e-4);
    }
  }
  EXPECT_GT(smooth, 1500);
}

TEST(World, RaysMeetSurfacesWhereStepsByDistanceDo) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const World world = random_world(seed);
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
      const Point origin = random_vector(random, -6.0, 6.0);
      const Eigen::Vector3d direction = random_direction(random);
      const double range = cast_ray(world, origin, direction);
      const double traced = sphere_trace(world, origin, direction, 50.0);
      if (std::isinf(traced)) {
        // A ray that grazes may be seen by one of the two alone.
        ASSERT_TRUE(range > 50.0 ||
                    std::abs(surface_distance(world, origin + range * direction).distance) < 1e-9);
      } else {
        ASSERT_NEAR(range, traced, 1e-4);
        ++met;
      }
    }
  }
  EXPECT_GT(met, 2000);
}

TEST(World, RaysAlongTheAxesAndFromInside) {
  World world;
  world.boxes.push_back({{5.0, 0.0, 0.0}, {2.0, 2.0, 2.0}});
  EXPECT_EQ(cast_ray(world, Point::Zero(), Eigen::Vector3d::UnitX()), 4.0);
  EXPECT_TRUE(std::isinf(cast_ray(world, Point::Zero(), -Eigen::Vector3d::UnitX())));
  EXPECT_TRUE(std::isinf(cast_ray(world, {0.0, 1.5, 0.0}, Eigen::Vector3d::UnitX())));
  EXPECT_EQ(cast_ray(world, {5.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ()), 0.0);
  world.cylinders.push_back({{0.0, 0.0, 10.0}, 1.0, 2.0});
  EXPECT_EQ(cast_ray(world, Point::Zero(), Eigen::Vector3d::UnitZ()), 9.0);
  EXPECT_TRUE(std::isinf(cast_ray(World{}, Point::Zero(), Eigen::Vector3d::UnitX())));
  EXPECT_TRUE(std::isinf(surface_distance(World{}, Point::Zero()).distance));
}

TEST(World, SolidsComeAndGo) {
  World world;
  world.boxes.push_back({{9.0, 0.0, 0.0}, {2.0, 2.0, 2.0}});
  TimedSolids door;
  door.from = 3.0;
  door.until = 5.0;
  door.boxes.push_back({{5.0, 0.0, 0.0}, {2.0, 2.0, 2.0}});
  door.spheres.push_back({{0.0, 5.0, 0.0}, 1.0});
  world.timed.push_back(door);
  const auto ahead = [&](double time) {
    return cast_ray(world_at(world, time), Point::Zero(), Eigen::Vector3d::UnitX());
  };
  EXPECT_EQ(cast_ray(world, Point::Zero(), Eigen::Vector3d::UnitX()), 8.0);
  EXPECT_EQ(ahead(2.999), 8.0);
  EXPECT_EQ(ahead(3.0), 4.0);
  EXPECT_EQ(ahead(4.999), 4.0);
  EXPECT_EQ(ahead(5.0), 8.0);
  EXPECT_EQ(cast_ray(world_at(world, 4.0), Point::Zero(), Eigen::Vector3d::UnitY()), 4.0);
  EXPECT_TRUE(world_at(world, 4.0).timed.empty());
  EXPECT_NO_THROW(validate_world(world));
  world.timed[0].spheres[0].radius = 0.0;
  EXPECT_THROW(validate_world(world), InputError);
  world.timed[0] = {};
  world.timed[0].from = std::nan("");
  EXPECT_THROW(validate_world(world), InputError);
}

TEST(World, SolidsWithoutASizeAreRefused) {
  const auto refused = [](const auto& spoil) {
    World world = random_world(1);
    spoil(world);
    EXPECT_THROW(validate_world(world), InputError);
  };
  EXPECT_NO_THROW(validate_world(random_world(1)));
  refused([](World& w) { w.boxes[1].size.y() = 0.0; });
  refused([](World& w) { w.boxes[1].centre.x() = std::nan(""); });
  refused([](World& w) { w.spheres[0].radius = -1.0; });
  refused([](World& w) { w.cylinders[2].height = std::numeric_limits<double>::infinity(); });
  refused([](World& w) { w.planes[0].normal *= 2.0; });
  refused([](World& w) { w.planes[0].offset = std::nan(""); });
}

}  // namespace
}  // namespace ridgeway
