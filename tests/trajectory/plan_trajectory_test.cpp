// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/trajectory/plan_trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

#include "experiments/flight_judge.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "support/random_maps.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

constexpr double kVoxel = 0.1;

/// A room of 20 x 20 x 4 m with a pillar of 2 x 2 m in its middle.
const OccupancyMap& room() {
  static const OccupancyMap map =
      testing::make_map(kVoxel, {0, 0, 0}, {199, 199, 39}, [](const VoxelIndex& v) {
        const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 199 || v.y == 199 || v.z == 39;
        const bool pillar = v.x >= 90 && v.x < 110 && v.y >= 90 && v.y < 110;
        return wall || pillar ? VoxelState::kOccupied : VoxelState::kFree;
      });
  return map;
}
const EsdfMap& esdf() {
  static const EsdfMap map = compute_esdf(room());
  return map;
}

void expect_flown(const TrajectoryResult& result, const std::vector<Point>& path,
                  const TrajectoryConfig& config) {
  static const FlightJudge judge(room(), UnknownPolicy::kObstacle);
  ASSERT_TRUE(result.ok()) << name_of(result.status);
  EXPECT_EQ(judge.judge(result, path.front(), path.back(), config).complaint, "");
  EXPECT_TRUE(config.limits.hold(result.peaks));
}

TEST(PlanTrajectory, AStraightPathTakesTheTimeOfItsProfile) {
  TrajectoryConfig config;
  const double v = 2.0, a = 2.0;
  for (const double length : {1e-6, 0.01, 0.3, 1.0, 2.0, 2.5, 3.0, 10.0, 16.0}) {
    SCOPED_TRACE(length);
    const std::vector<Point> path{{2, 5, 2}, {2 + length, 5, 2}};
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    const double expected =
        length >= 1.1 * v * v / a ? length / v + 1.1 * v / a : std::sqrt(4.4 * length / a);
    EXPECT_NEAR(result.duration, expected, 2e-5 * expected);
    const double trapezoid = length >= v * v / a ? length / v + v / a : 2 * std::sqrt(length / a);
    EXPECT_LE(result.duration, 1.05 * trapezoid);
    EXPECT_EQ(result.step, TrajectoryStep::kSmooth);
  }
}

TEST(PlanTrajectory, StaysWithinTheLimitsOfTheFlight) {
  int smooth = 0;
  for (const double width : {0.05, 0.4, 2.0}) {
    SCOPED_TRACE(width);
    TrajectoryConfig config;
    config.flight_limits.keep_in.min.z() = 1.0;
    config.flight_limits.keep_in.max.z() = 1.0 + width;
    config.flight_limits.keep_out = {{Point(4, 4, 0), Point(7, 7, 4)}};
    // Along both faces of the band, and close around corners of the box.
    const std::vector<Point> path{{2, 2, 1.0},   {2, 7, 1.0 + width}, {7, 7, 1.0 + width},
                                  {7, 2, 1.0},   {14, 2, 1.0},        {16, 8, 1.0 + 0.5 * width},
                                  {12, 16, 1.0}, {2, 16, 1.0 + width}};
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    smooth += result.step != TrajectoryStep::kStopAndGo;
    for (const TrajectoryState& state : result.trajectory.sample(0.002)) {
      ASSERT_GE(state.position.z(), 1.0 - 2e-8);
      ASSERT_LE(state.position.z(), 1.0 + width + 2e-8);
      const Point p = state.position;
      ASSERT_FALSE(p.x() > 4 + 2e-8 && p.x() < 7 - 2e-8 && p.y() > 4 + 2e-8 && p.y() < 7 - 2e-8);
    }
    const std::vector<Point> out{{2, 2, 1.0}, {2, 7, 1.0 + width + 1e-6}};
    EXPECT_EQ(plan_trajectory(esdf(), out, config).status, TrajectoryStatus::kPathNotFree);
    const std::vector<Point> through{{2, 5, 1.0}, {9, 5, 1.0}};
    EXPECT_EQ(plan_trajectory(esdf(), through, config).status, TrajectoryStatus::kPathNotFree);
  }
  EXPECT_EQ(smooth, 3);
}

TEST(PlanTrajectory, LimitsHoldForAnyLimits) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0), place(1.0, 6.0);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TrajectoryConfig config;
    config.limits.max_speed = 2.0 * std::pow(10.0, exponent(random));
    config.limits.max_acceleration = 2.0 * std::pow(10.0, exponent(random));
    if (i % 2 == 0) config.limits.max_jerk = 10.0 * std::pow(10.0, exponent(random));
    config.limits.max_yaw_rate = std::pow(10.0, exponent(random));
    config.smoothness = i % 4 < 2 ? Smoothness::kSnap : Smoothness::kJerk;
    std::vector<Point> path;
    path.reserve(7);
    for (int k = 0; k < 2 + i % 5; ++k) path.emplace_back(place(random), place(random), 2.0);
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    EXPECT_LE(result.duration, result.stop_and_go_duration * (1 + 1e-12));
  }
}

TEST(PlanTrajectory, ExtremeLimitsGetATrajectory) {
  const std::vector<Point> path{{3, 3, 2}, {5, 3, 2}, {5, 6, 1}};
  for (const double speed : {1e-9, 1e-3, 1.0, 1e3, 1e9})
    for (const double acceleration : {1e-9, 1e-3, 1.0, 1e3, 1e9})
      for (const double jerk : {1e-9, 1.0, 1e9}) {
        SCOPED_TRACE(::testing::Message() << speed << " " << acceleration << " " << jerk);
        TrajectoryConfig config;
        config.limits.max_speed = speed;
        config.limits.max_acceleration = acceleration;
        config.limits.max_jerk = jerk;
        const TrajectoryResult result = plan_trajectory(esdf(), path, config);
        ASSERT_TRUE(result.ok()) << name_of(result.status);
        EXPECT_TRUE(config.limits.hold(result.peaks));
        EXPECT_LE(result.duration, result.stop_and_go_duration * (1 + 1e-12));
        EXPECT_GE(result.clearance, config.radius * (1 - 1e-9));
      }
}

TEST(PlanTrajectory, RoundsAPillarWithoutStopping) {
  const std::vector<Point> path{{5, 10, 2}, {8.7, 8.6, 2}, {11.3, 8.6, 2}, {15, 10, 2}};
  const TrajectoryConfig config;
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  EXPECT_EQ(result.stops, 0);
  EXPECT_LT(result.duration, 0.85 * result.stop_and_go_duration);
  EXPECT_GT(result.cost.time, 0.0);
  EXPECT_GT(result.evaluations, 5);
}

TEST(PlanTrajectory, ThePlainSplinePassesTheCornersWithinTheLimits) {
  const std::vector<Point> path{{5, 10, 2}, {8.7, 8.6, 2}, {11.3, 8.6, 2}, {15, 10, 2}};
  const TrajectoryConfig config;
  const Trajectory spline = plain_spline(path, config);
  EXPECT_TRUE(config.limits.hold(find_peaks(spline)));
  std::vector<double> nearest(path.size(), 1e9);
  for (const TrajectoryState& state : spline.sample(1e-3))
    for (std::size_t i = 0; i < path.size(); ++i)
      nearest[i] = std::min(nearest[i], (state.position - path[i]).norm());
  for (const double distance : nearest) EXPECT_LE(distance, 2e-3);
  EXPECT_GT(spline.duration(), plan_trajectory(esdf(), path, config).duration);
  EXPECT_EQ(plain_spline(std::vector<Point>{path[0]}, config).duration(), 0.0);
  EXPECT_THROW(plain_spline({}, config), InputError);
}

TEST(PlanTrajectory, StopAndGoFollowsThePathExactly) {
  const std::vector<Point> path{{5, 10, 2}, {8.7, 8.6, 2}, {11.3, 8.6, 2}, {15, 10, 2}};
  TrajectoryConfig config;
  config.stop_and_go = true;
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  EXPECT_EQ(result.step, TrajectoryStep::kStopAndGo);
  EXPECT_EQ(result.stops, 2);
  EXPECT_DOUBLE_EQ(result.duration, result.stop_and_go_duration);
  for (const TrajectoryState& state : result.trajectory.sample(0.01)) {
    double off = 1e9;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Point along = path[i] - path[i - 1];
      const double t =
          std::clamp((state.position - path[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      off = std::min(off, (path[i - 1] + t * along - state.position).norm());
    }
    EXPECT_LE(off, 1e-9);
  }
}

// Limits for which holding an acceleration, or a speed, takes no time but for rounding.
TEST(PlanTrajectory, StopAndGoHoldsTheLimitOfYawWhereAPieceWouldTakeNoTime) {
  const std::vector<Point> path{{2, 4, 2}, {4.5, 4.5, 2}, {4, 1.5, 2}};
  for (const double speed : {0.2, 0.5, 1.0, 2.0})
    for (const double acceleration : {0.3, 1.0, 3.0, 10.0})
      for (const double jerk : {0.5, 1.0, 5.0, 20.0}) {
        TrajectoryConfig config;
        config.stop_and_go = true;
        config.limits.max_speed = speed;
        config.limits.max_acceleration = acceleration;
        config.limits.max_jerk = jerk;
        const TrajectoryResult result = plan_trajectory(esdf(), path, config);
        ASSERT_TRUE(result.ok());
        EXPECT_LE(result.peaks.yaw_rate, config.limits.max_yaw_rate * (1 + 1e-9));
        EXPECT_LE(result.peaks.speed, speed * (1 + 1e-9));
        EXPECT_LE(result.peaks.jerk, jerk * (1 + 1e-9));
        for (const TrajectorySegment& segment : result.trajectory.segments)
          EXPECT_GT(segment.duration, 1e-9);
      }
}

TEST(PlanTrajectory, PassesADoorOfExactlyTheRobotsWidth) {
  const EsdfMap map = compute_esdf(testing::test_shape("door_of_the_robots_width").map());
  TrajectoryConfig config;
  config.radius = 0.35;  // between 1.2 and 1.9
  const std::vector<Point> path{
      {1.0, 0.8, 0.5}, {2.5, 1.55, 0.5}, {3.6, 1.55, 0.5}, {5.0, 2.2, 0.5}};
  const TrajectoryResult result = plan_trajectory(map, path, config);
  ASSERT_TRUE(result.ok()) << name_of(result.status);
  EXPECT_GE(result.clearance, 0.35 * (1 - 1e-9));
  EXPECT_LE(result.clearance, 0.35 + 1e-9);
}

TEST(PlanTrajectory, JoinsFourTimesContinuouslyAndStartsAndEndsAtRest) {
  const std::vector<Point> path{{2, 2, 1}, {9, 3, 2}, {14, 8, 3}, {15, 16, 1}};
  for (const bool stop_and_go : {false, true}) {
    TrajectoryConfig config;
    config.stop_and_go = stop_and_go;
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    ASSERT_TRUE(result.ok());
    const auto& segments = result.trajectory.segments;
    for (int order = 1; order <= 4; ++order) {
      EXPECT_LE(segments.front().derivative(order, 0.0).norm(), 1e-6);
      EXPECT_LE(segments.back().derivative(order, segments.back().duration).norm(), 1e-5);
      for (std::size_t i = 1; i < segments.size(); ++i)
        EXPECT_LE((segments[i].derivative(order, 0.0) -
                   segments[i - 1].derivative(order, segments[i - 1].duration))
                      .norm(),
                  1e-5)
            << order;
    }
  }
}

TEST(PlanTrajectory, DegeneratePathsGetATrajectory) {
  const TrajectoryConfig config;
  const Point a(3, 3, 2), b(6, 3, 2), c(6, 7, 2);
  const std::vector<std::vector<Point>> paths = {
      {a},
      {a, a},
      {a, a, b, b, b, c, c},
      {a, Point(4, 3, 2), Point(5, 3, 2), b},  // on one line
      {a, b, a},                               // there and back
      {a, b, a, b},
      {a, a + Point(1e-9, 0, 0), b},
      {a, Point(3, 3, 3)},           // straight up
      {a, b, c, Point(3, 7, 2), a},  // in one plane, and round
  };
  for (std::size_t i = 0; i < paths.size(); ++i) {
    SCOPED_TRACE(i);
    const TrajectoryResult result = plan_trajectory(esdf(), paths[i], config);
    expect_flown(result, paths[i], config);
    EXPECT_LE(result.duration, result.stop_and_go_duration * (1 + 1e-12));
    for (const TrajectoryState& state : result.trajectory.sample(0.1))
      EXPECT_TRUE(state.position.allFinite() && std::isfinite(state.yaw));
  }
  EXPECT_EQ(plan_trajectory(esdf(), paths[0], config).duration, 0.0);
}

/// A way out that is shorter than the knots are apart, and back to where it began.
TEST(PlanTrajectory, ThereAndBackGetsATrajectory) {
  const TrajectoryConfig config;
  for (const double way : {1e-3, 0.05, 0.2, 0.3, 0.6, 2.0}) {
    SCOPED_TRACE(way);
    const std::vector<Point> path{{2, 5, 2}, {2 + way, 5, 2}, {2, 5, 2}};
    expect_flown(plan_trajectory(esdf(), path, config), path, config);
    const std::vector<Point> twice{
        {2, 5, 2}, {2 + way, 5, 2}, {2, 5 + way, 2}, {2 + way, 5, 2}, {2, 5, 2}};
    expect_flown(plan_trajectory(esdf(), twice, config), twice, config);
  }
}

/// How near a trajectory comes to a place.
double nearest_to(const Trajectory& trajectory, const Point& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const TrajectoryState& state : trajectory.sample(1e-3))
    nearest = std::min(nearest, (state.position - place).norm());
  return nearest;
}

TEST(PlanTrajectory, PassesThePlacesThatItIsToPass) {
  const std::vector<Point> path{{2, 5, 2}, {2.3, 5, 2}, {6, 5, 2}, {6, 7, 2}, {2, 5.5, 2}};
  constexpr double kStep = 2e-3;  // metres between two samples
  for (const Smoothness smoothness : {Smoothness::kSnap, Smoothness::kJerk})
    for (const double speed : {1.0, 2.0, 5.0}) {
      SCOPED_TRACE(speed);
      TrajectoryConfig config;
      config.smoothness = smoothness;
      config.limits.max_speed = speed;
      const TrajectoryResult rounded = plan_trajectory(esdf(), path, config);
      EXPECT_GT(nearest_to(rounded.trajectory, path[2]), 0.1);
      for (const std::vector<Point>& via :
           {std::vector{path[2]}, std::vector{path[1], path[3]}, {path[1], path[2], path[3]}}) {
        config.via = via;
        const TrajectoryResult result = plan_trajectory(esdf(), path, config);
        expect_flown(result, path, config);
        for (const Point& place : via)
          EXPECT_LT(nearest_to(result.trajectory, place), speed * kStep);
      }
    }
}

TEST(PlanTrajectory, ThousandWaypointsTakeSeconds) {
  std::vector<Point> spiral, dense;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.05 * i, radius = 3.0 + 0.005 * i;
    spiral.emplace_back(10 + radius * std::cos(angle), 10 + radius * std::sin(angle), 2.0);
    dense.emplace_back(2.0 + 0.01 * i, 5.0 + 0.02 * (i % 2), 2.0);
  }
  for (const auto& path : {spiral, dense}) {
    const TrajectoryConfig config;
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    EXPECT_LT(result.duration, 0.5 * result.stop_and_go_duration);
  }
}

TEST(PlanTrajectory, StartsFromAMotion) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  int braked = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TrajectoryConfig config;
    config.start_velocity = 1.8 * Point(part(random), part(random), 0.3 * part(random)) / 1.5;
    config.start_acceleration = Point(part(random), part(random), 0.0);
    const std::vector<Point> path{{4, 6, 2}, {7, 6.5, 2}, {8, 12, 1}};
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    const TrajectoryState start = result.trajectory.at(0.0);
    EXPECT_LE((start.velocity - config.start_velocity).norm(), 1e-9);
    EXPECT_LE((start.acceleration - config.start_acceleration).norm(), 1e-9);
    braked += result.braked;
  }
  EXPECT_LT(braked, 10);
}

/// Stretching every piece of a long way for one that is beyond the limits would have the robot
/// crawl all along.
TEST(PlanTrajectory, DoesNotCrawlFromAMotion) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const std::vector<Point> path{{4, 6, 2},   {7, 6.5, 2}, {8, 12, 1}, {12, 17, 2},
                                {16, 16, 2}, {17, 10, 2}, {14, 4, 2}, {17, 2, 1}};
  TrajectoryConfig config;
  config.most_evaluations = 30;
  const double from_rest = plan_trajectory(esdf(), path, config).duration;
  double slowest = 0.0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const double yaw = 3.14 * part(random);
    config.start_velocity = (1.6 + 0.38 * part(random)) * Point(std::cos(yaw), std::sin(yaw), 0.0);
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    slowest = std::max(slowest, result.duration / from_rest);
  }
  EXPECT_LT(slowest, 1.3);
}

TEST(PlanTrajectory, BrakesWhereItCannotFollowAndSaysWhereItCannotStop) {
  TrajectoryConfig config;
  config.start_velocity = {2.0, 0.0, 0.0};
  config.stop_and_go = true;  // straight legs cannot be joined in motion
  const std::vector<Point> away{{3, 6, 2}, {3, 9, 2}};
  const TrajectoryResult result = plan_trajectory(esdf(), away, config);
  expect_flown(result, away, config);
  const std::vector<Point> at_the_wall{{19.3, 6, 2}, {19.3, 9, 2}};
  const TrajectoryResult too_late = plan_trajectory(esdf(), at_the_wall, config);
  EXPECT_EQ(too_late.status, TrajectoryStatus::kCannotStopInTime);
  EXPECT_TRUE(too_late.trajectory.segments.empty());
}

TEST(PlanTrajectory, YawFollowsTheDirectionOfTravelWithoutJumps) {
  // Once round the pillar and a half, over the place where atan2 jumps.
  std::vector<Point> path;
  for (int i = 0; i <= 90; ++i) {
    const double angle = 0.1 * i;
    path.emplace_back(10 + 5 * std::cos(angle), 10 + 5 * std::sin(angle), 2.0);
  }
  TrajectoryConfig config;
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  double before = result.trajectory.at(0.0).yaw, worst = 0.0;
  EXPECT_NEAR(before, std::numbers::pi / 2, 0.2);
  for (const TrajectoryState& state : result.trajectory.sample(0.01)) {
    EXPECT_LE(std::abs(state.yaw - before), 0.02);
    before = state.yaw;
    if (state.velocity.norm() < 1.0) continue;
    const double heading = std::atan2(state.velocity.y(), state.velocity.x());
    worst = std::max(worst, std::abs(std::remainder(state.yaw - heading, 2 * std::numbers::pi)));
  }
  EXPECT_LE(worst, 0.35);
  EXPECT_GT(before, 9.0);  // unwrapped

  // From stop to stop over a right angle: it has turned a second and a half after the stop, however
  // long the leg.
  const std::vector<Point> corner{{3, 3, 2}, {6, 3, 2}, {6, 17, 2}};
  TrajectoryConfig stopping;
  stopping.stop_and_go = true;
  const TrajectoryResult stopped = plan_trajectory(esdf(), corner, stopping);
  expect_flown(stopped, corner, stopping);
  const double stop = 0.5 * 3 + 1.1, turned = stop + 0.5 * std::numbers::pi * 2.5 / 1.5;
  EXPECT_NEAR(stopped.trajectory.at(stop - 0.5).yaw, 0.0, 0.01);
  EXPECT_NEAR(stopped.trajectory.at(turned + 0.5).yaw, std::numbers::pi / 2, 0.01);

  config.follow_yaw = false;
  config.start_yaw = 1.0;
  const TrajectoryResult fixed = plan_trajectory(esdf(), path, config);
  for (const TrajectoryState& state : fixed.trajectory.sample(0.1)) EXPECT_EQ(state.yaw, 1.0);
}

TEST(PlanTrajectory, RefusesBadInputByName) {
  const std::vector<Point> path{{3, 3, 2}, {6, 3, 2}};
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const std::string& field, auto&& change) {
    TrajectoryConfig config;
    change(config);
    try {
      plan_trajectory(esdf(), path, config);
      ADD_FAILURE() << field << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(error.where().find(field), std::string::npos) << error.what();
    }
  };
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    refused("radius", [&](auto& c) { c.radius = bad; });
    refused("max_speed", [&](auto& c) { c.limits.max_speed = bad; });
    refused("max_acceleration", [&](auto& c) { c.limits.max_acceleration = bad; });
    if (bad == infinity) continue;
    refused("max_jerk", [&](auto& c) { c.limits.max_jerk = bad; });
    refused("max_yaw_rate", [&](auto& c) { c.limits.max_yaw_rate = bad; });
  }
  refused("start_velocity", [&](auto& c) { c.start_velocity.x() = nan; });
  refused("start_velocity", [&](auto& c) { c.start_velocity.x() = 2.1; });
  refused("start_acceleration", [&](auto& c) { c.start_acceleration.x() = 2.1; });
  refused("start_yaw", [&](auto& c) { c.start_yaw = nan; });
  refused("most_evaluations", [&](auto& c) { c.most_evaluations = 0; });
  EXPECT_THROW(plan_trajectory(esdf(), {}, {}), InputError);
  EXPECT_THROW(plan_trajectory(esdf(), std::vector<Point>{{1, nan, 1}}, {}), InputError);
}

TEST(PlanTrajectory, KnowsHallsLargerThanMaxDistance) {
  const EsdfMap near = compute_esdf(room(), {.max_distance = 0.8});
  const std::vector<Point> path{{3, 3, 2}, {16, 4, 2}, {16, 16, 2}};
  const TrajectoryResult result = plan_trajectory(near, path, {});
  expect_flown(result, path, {});
  EXPECT_EQ(result.step, TrajectoryStep::kSmooth);
  TrajectoryConfig config;
  config.radius = 0.7;
  EXPECT_THROW(plan_trajectory(near, path, config), InputError);
}

TEST(PlanTrajectory, SaysWhenThePathIsNotFree) {
  for (const std::vector<Point>& path : {std::vector<Point>{{5, 10, 2}, {15, 10, 2}},
                                         {{5, 10, 2}, {50, 10, 2}},
                                         {{10, 10, 2}},
                                         {{5, 10, 2}, {1e300, 10, 2}}}) {
    const TrajectoryResult result = plan_trajectory(esdf(), path, {});
    EXPECT_EQ(name_of(result.status), "path_not_free");
    EXPECT_TRUE(result.trajectory.segments.empty());
  }
}

TEST(PlanTrajectory, StatusesAndStepsMadeByACastHaveNoName) {
  EXPECT_EQ(name_of(static_cast<TrajectoryStatus>(3)), "invalid");
  EXPECT_EQ(name_of(static_cast<TrajectoryStep>(200)), "invalid");
}

TEST(PlanTrajectory, IsTheSameFromManyThreads) {
  const std::vector<Point> path{{5, 10, 2}, {8.7, 8.6, 2}, {11.3, 8.6, 2}, {15, 10, 2}};
  const TrajectoryResult alone = plan_trajectory(esdf(), path, {});
  std::vector<TrajectoryResult> results(4);
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (TrajectoryResult& mine : results)
    threads.emplace_back([&] { mine = plan_trajectory(esdf(), path, {}); });
  for (std::thread& thread : threads) thread.join();
  for (const TrajectoryResult& result : results) {
    ASSERT_EQ(result.trajectory.segments.size(), alone.trajectory.segments.size());
    for (std::size_t i = 0; i < alone.trajectory.segments.size(); ++i)
      EXPECT_EQ(result.trajectory.segments[i].coefficients,
                alone.trajectory.segments[i].coefficients);
  }
}

TEST(VerifyTrajectory, DoubtsWhatCollidesBetweenSamplesAndNothingThatIsFree) {
  // Parabolas towards a corner of the pillar: it stands at (9, 9), the curve turns at its tip.
  for (const double radius : {0.2, 0.4})
    for (double gap = -0.2; gap <= 0.2; gap += 0.01) {
      const double diagonal = std::numbers::sqrt2 / 2.0, off = (radius + gap) * diagonal;
      TrajectorySegment segment;
      segment.duration = 2.0;
      // Tip at the corner less `off` on both axes, at t = 1; it bends away from the pillar.
      const double bend = 3.0;
      segment.coefficients.col(0) << 9 - off - bend - 1, 9 - off - bend + 1, 2, 0;
      segment.coefficients.col(1) << 2 * bend + 1, 2 * bend - 1, 0, 0;
      segment.coefficients.col(2) << -bend, -bend, 0, 0;
      const bool is_free = find_doubts(esdf(), {{segment}}, radius).empty();
      EXPECT_EQ(is_free, gap > 1e-9) << radius << " " << gap;
      if (!is_free) continue;
      EXPECT_NEAR(clearance_of(esdf(), {{segment}}), radius + gap, 1.1e-3);
    }
}

TEST(PlanTrajectory, YawWithoutALimitBeginsWhereItIs) {
  const std::vector<Point> path = {{3, 3, 1}, {7, 5, 1}, {7, 9, 1}};
  for (const double rate : {1e3, 1e9, 1e40, HUGE_VAL}) {
    TrajectoryConfig config;
    config.limits.max_yaw_rate = rate;
    config.start_yaw = 2.5;
    const TrajectoryResult flown = plan_trajectory(esdf(), path, config);
    ASSERT_TRUE(flown.ok()) << rate;
    EXPECT_NEAR(flown.trajectory.at(0.0).yaw, 2.5, 1e-9) << rate;
    EXPECT_TRUE(std::isfinite(flown.peaks.yaw_rate)) << rate;
    for (const TrajectoryState& at : flown.trajectory.sample(0.01))
      ASSERT_TRUE(std::isfinite(at.yaw) && std::isfinite(at.yaw_rate)) << rate;
  }
}

TEST(PlanTrajectory, InAPlaneHeightsPlayNoPartAndRobotsHaveNone) {
  OccupancyMap plane = testing::make_map(0.1, {0, 0, 0}, {59, 39, 7}, [](const VoxelIndex& v) {
    const bool is_wall = v.x == 0 || v.y == 0 || v.x == 59 || v.y == 39;
    return is_wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
  plane.planar = true;
  const EsdfMap map = compute_esdf(plane);
  TrajectoryConfig config;
  const std::vector<Point> path = {{1, 1, -5}, {4, 3, 7}};
  const TrajectoryResult flown = plan_trajectory(map, path, config);
  ASSERT_TRUE(flown.ok()) << name_of(flown.status);
  EXPECT_EQ(flown.trajectory.at(1.0).position.z(), flown.trajectory.at(0.0).position.z());
  config.robot_height = 0.4;
  EXPECT_THROW(plan_trajectory(map, path, config), InputError);
}

}  // namespace
}  // namespace ridgeway
