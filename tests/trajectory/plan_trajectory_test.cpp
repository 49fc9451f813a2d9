// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/trajectory/plan_trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "ridgeway/common/error.hpp"
#include "support/shapes.hpp"
#include "trajectory/pillar_room.hpp"

namespace ridgeway {
namespace {

using testing::esdf;
using testing::expect_flown;

TEST(PlanTrajectory, AStraightPathTakesTheTimeOfItsProfile) {
  TrajectoryConfig config{.radius = 0.3};
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

TEST(PlanTrajectory, RoundsAPillarWithoutStopping) {
  const std::vector<Point> path{{5, 10, 2}, {8.7, 8.6, 2}, {11.3, 8.6, 2}, {15, 10, 2}};
  const TrajectoryConfig config{.radius = 0.3};
  const TrajectoryResult result = plan_trajectory(esdf(), path, config);
  expect_flown(result, path, config);
  EXPECT_EQ(result.stops, 0);
  EXPECT_LT(result.duration, 0.85 * result.stop_and_go_duration);
  EXPECT_GT(result.cost.time, 0.0);
  EXPECT_GT(result.evaluations, 5);
}

TEST(PlanTrajectory, ThePlainSplinePassesTheCornersWithinTheLimits) {
  const std::vector<Point> path{{5, 10, 2}, {8.7, 8.6, 2}, {11.3, 8.6, 2}, {15, 10, 2}};
  const TrajectoryConfig config{.radius = 0.3};
  const Trajectory spline = plain_spline(path, config);
  EXPECT_TRUE(config.motion.hold(find_peaks(spline)));
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
  TrajectoryConfig config{.radius = 0.3};
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

TEST(PlanTrajectory, PassesADoorOfExactlyTheRobotsWidth) {
  const EsdfMap map = compute_esdf(testing::test_shape("door_of_the_robots_width").map());
  TrajectoryConfig config{.radius = 0.35};  // between 1.2 and 1.9
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
    TrajectoryConfig config{.radius = 0.3};
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
  const TrajectoryConfig config{.radius = 0.3};
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
  const TrajectoryConfig config{.radius = 0.3};
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
      TrajectoryConfig config{.radius = 0.3};
      config.smoothness = smoothness;
      config.motion.max_speed = speed;
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

TEST(PlanTrajectory, PassesPlacesThatAlmostTouch) {
  for (const double apart : {1e-3, 1e-6, 1e-8, 1e-10, 1e-13})
    for (const Point& end : {Point(2, 5, 2), Point(6, 5, 2), Point(2, 5.5, 2)}) {
      SCOPED_TRACE(apart);
      std::vector<Point> path{{2, 5, 2}, {6, 5, 2}, {6, 7, 2}, {2, 5.5, 2}};
      const Point close = end + Point(apart, 0, 0);
      path.insert(std::find(path.begin(), path.end(), end) + (end == path.back() ? 0 : 1), close);
      TrajectoryConfig config{.radius = 0.3};
      config.via = {end, close};
      const TrajectoryResult result = plan_trajectory(esdf(), path, config);
      expect_flown(result, path, config);
      EXPECT_LT(nearest_to(result.trajectory, close), 5e-3);
    }
}

TEST(PlanTrajectory, RefusesToPassWhatIsNoPointOfThePath) {
  const std::vector<Point> path{{2, 5, 2}, {6, 5, 2}, {6, 7, 2}};
  for (const Point& place : {Point(4, 5, 2), Point(6, 5, 2 + 1e-9), Point(0, 0, 9)}) {
    TrajectoryConfig config{.radius = 0.3};
    config.via = {path[1], place};
    try {
      plan_trajectory(esdf(), path, config);
      ADD_FAILURE() << place.transpose();
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), "via");
    }
  }
}

TEST(PlanTrajectory, PointsOnAStraightWayAreNoCorners) {
  TrajectoryConfig config{.radius = 0.3};
  const auto seconds = [&](const std::vector<Point>& path) {
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    return result.duration;
  };
  const double straight = seconds({{2, 5, 2}, {12, 7, 2}});
  const std::vector<Point> dotted{{2, 5, 2}, {4, 5.4, 2}, {7, 6, 2}, {12, 7, 2}};
  EXPECT_DOUBLE_EQ(seconds(dotted), straight);
  config.via = {dotted[1]};
  EXPECT_DOUBLE_EQ(seconds(dotted), straight);  // it is passed all the same
  config.via = {};
  EXPECT_NEAR(seconds({{2, 5, 2}, {4, 5.4, 2}, {7, 6, 2}, {7, 2, 2}}),
              seconds({{2, 5, 2}, {7, 6, 2}, {7, 2, 2}}), 1e-9);
  // Back over the same line is a way of its own.
  EXPECT_GT(seconds({{2, 5, 2}, {12, 7, 2}, {7, 6, 2}}), straight);
}

TEST(PlanTrajectory, ThousandWaypointsTakeSeconds) {
  std::vector<Point> spiral, dense;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.05 * i, radius = 3.0 + 0.005 * i;
    spiral.emplace_back(10 + radius * std::cos(angle), 10 + radius * std::sin(angle), 2.0);
    dense.emplace_back(2.0 + 0.01 * i, 5.0 + 0.02 * (i % 2), 2.0);
  }
  for (const auto& path : {spiral, dense}) {
    const TrajectoryConfig config{.radius = 0.3};
    const TrajectoryResult result = plan_trajectory(esdf(), path, config);
    expect_flown(result, path, config);
    EXPECT_LT(result.duration, 0.5 * result.stop_and_go_duration);
  }
}

TEST(PlanTrajectory, RefusesBadInputByName) {
  const std::vector<Point> path{{3, 3, 2}, {6, 3, 2}};
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const std::string& field, auto&& change) {
    TrajectoryConfig config{.radius = 0.3};
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
    refused("max_speed", [&](auto& c) { c.motion.max_speed = bad; });
    refused("max_acceleration", [&](auto& c) { c.motion.max_acceleration = bad; });
    if (bad == infinity) continue;
    refused("max_jerk", [&](auto& c) { c.motion.max_jerk = bad; });
    refused("max_yaw_rate", [&](auto& c) { c.motion.max_yaw_rate = bad; });
  }
  refused("start_velocity", [&](auto& c) { c.start_velocity.x() = nan; });
  refused("start_velocity", [&](auto& c) { c.start_velocity.x() = 2.1; });
  refused("start_acceleration", [&](auto& c) { c.start_acceleration.x() = 2.1; });
  refused("start_yaw", [&](auto& c) { c.start_yaw = nan; });
  refused("most_evaluations", [&](auto& c) { c.most_evaluations = 0; });
  refused("smoothness", [&](auto& c) { c.smoothness = static_cast<Smoothness>(9); });
  EXPECT_THROW(plan_trajectory(esdf(), {}, {.radius = 0.3}), InputError);
  EXPECT_THROW(plan_trajectory(esdf(), std::vector<Point>{{1, nan, 1}}, {.radius = 0.3}),
               InputError);
}

TEST(PlanTrajectory, KnowsHallsLargerThanMaxDistance) {
  const EsdfMap near = compute_esdf(testing::pillar_room(), {.max_distance = 0.8});
  const std::vector<Point> path{{3, 3, 2}, {16, 4, 2}, {16, 16, 2}};
  const TrajectoryResult result = plan_trajectory(near, path, {.radius = 0.3});
  expect_flown(result, path, {.radius = 0.3});
  EXPECT_EQ(result.step, TrajectoryStep::kSmooth);
  TrajectoryConfig config{.radius = 0.7};
  EXPECT_THROW(plan_trajectory(near, path, config), InputError);
}

TEST(PlanTrajectory, SaysWhenThePathIsNotFree) {
  for (const std::vector<Point>& path : {std::vector<Point>{{5, 10, 2}, {15, 10, 2}},
                                         {{5, 10, 2}, {50, 10, 2}},
                                         {{10, 10, 2}},
                                         {{5, 10, 2}, {1e300, 10, 2}}}) {
    const TrajectoryResult result = plan_trajectory(esdf(), path, {.radius = 0.3});
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
  const TrajectoryResult alone = plan_trajectory(esdf(), path, {.radius = 0.3});
  std::vector<TrajectoryResult> results(4);
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (TrajectoryResult& mine : results)
    threads.emplace_back([&] { mine = plan_trajectory(esdf(), path, {.radius = 0.3}); });
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

TEST(PlanTrajectory, InAPlaneHeightsPlayNoPartAndRobotsHaveNone) {
  OccupancyMap plane = testing::make_map(0.1, {0, 0, 0}, {59, 39, 7}, [](const VoxelIndex& v) {
    const bool is_wall = v.x == 0 || v.y == 0 || v.x == 59 || v.y == 39;
    return is_wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
  plane.planar = true;
  const EsdfMap map = compute_esdf(plane);
  TrajectoryConfig config{.radius = 0.3};
  const std::vector<Point> path = {{1, 1, -5}, {4, 3, 7}};
  const TrajectoryResult flown = plan_trajectory(map, path, config);
  ASSERT_TRUE(flown.ok()) << name_of(flown.status);
  EXPECT_EQ(flown.trajectory.at(1.0).position.z(), flown.trajectory.at(0.0).position.z());
  config.start_velocity = {0.1, 0.1, 0.3};
  config.start_acceleration = {0.0, 0.0, -0.2};
  const TrajectoryResult moving = plan_trajectory(map, path, config);
  ASSERT_TRUE(moving.ok()) << name_of(moving.status);
  EXPECT_LT((moving.trajectory.at(0.0).velocity - Point(0.1, 0.1, 0.0)).norm(), 1e-12);
  EXPECT_EQ(moving.trajectory.at(1.0).position.z(), moving.trajectory.at(0.0).position.z());
  config.robot_height = 0.4;
  EXPECT_THROW(plan_trajectory(map, path, config), InputError);
}

}  // namespace
}  // namespace ridgeway
