// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/flight_judge.hpp"

#include <gtest/gtest.h>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

const Point kStart(1.05, 1.05, 1.05), kGoal(5.05, 1.05, 1.05);

/// A room of 6 x 2 x 2 m, one voxel of its middle in another state.
OccupancyMap room(VoxelState middle = VoxelState::kFree) {
  return testing::make_map(0.1, {0, 0, 0}, {59, 19, 19}, [&](const VoxelIndex& v) {
    const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 59 || v.y == 19 || v.z == 19;
    if (v == VoxelIndex{30, 10, 10}) return middle;
    return wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

/// From one end of the room to the other, stopping on the way.
TrajectoryResult good_flight() {
  TrajectoryConfig config{.radius = 0.3};
  config.stop_and_go = true;
  TrajectoryResult result = plan_trajectory(
      compute_esdf(room()), std::vector<Point>{kStart, Point(3.05, 1.3, 1.05), kGoal}, config);
  EXPECT_TRUE(result.ok());
  return result;
}

std::string complaint(const TrajectoryResult& flown, const OccupancyMap& map = room(),
                      UnknownPolicy policy = UnknownPolicy::kObstacle) {
  return FlightJudge(map, policy).judge(flown, kStart, kGoal, {.radius = 0.3}).complaint;
}

/// The same curve in another time.
TrajectoryResult slowed_down(TrajectoryResult flown, double factor) {
  for (TrajectorySegment& segment : flown.trajectory.segments) {
    segment.duration *= factor;
    double power = 1.0;
    for (int k = 0; k < kCoefficients; ++k, power *= factor) segment.coefficients.col(k) /= power;
  }
  return flown;
}

/// At constant speed, from motion to motion.
TrajectorySegment piece(const Point& from, const Point& to, double duration) {
  TrajectorySegment segment;
  segment.duration = duration;
  segment.coefficients.col(0).head<3>() = from;
  segment.coefficients.col(1).head<3>() = (to - from) / duration;
  return segment;
}

TEST(FlightJudge, PassesAGoodFlightAndMeasuresIt) {
  const TrajectoryResult flown = good_flight();
  const FlightVerdict verdict =
      FlightJudge(room(), UnknownPolicy::kObstacle).judge(flown, kStart, kGoal, {.radius = 0.3});
  EXPECT_EQ(verdict.complaint, "");
  EXPECT_NEAR(verdict.length, 2.0 * std::hypot(2.0, 0.25), 1e-5);
  EXPECT_NEAR(verdict.speed, flown.peaks.speed, 1e-3);
  EXPECT_NEAR(verdict.acceleration, flown.peaks.acceleration, 1e-3);
  EXPECT_NEAR(verdict.jerk, flown.peaks.jerk, 1e-3 * flown.peaks.jerk);
  EXPECT_NEAR(verdict.yaw_rate, flown.peaks.yaw_rate, 1e-3);
  EXPECT_EQ(verdict.clearance, 0.35);  // the radius and half a voxel: walls are farther
}

TEST(FlightJudge, ComplainsOfAFlightBeyondItsLimits) {
  EXPECT_EQ(complaint(slowed_down(good_flight(), 1.01)), "");
  EXPECT_EQ(complaint(slowed_down(good_flight(), 0.999)).substr(0, 12), "acceleration");
  TrajectoryConfig config{.radius = 0.3};
  config.motion.max_speed = 0.5;
  const FlightJudge judge(room(), UnknownPolicy::kObstacle);
  const auto words = [&] {
    return judge.judge(good_flight(), kStart, kGoal, config).complaint.substr(0, 5);
  };
  EXPECT_EQ(words(), "speed");
  config.motion = {.max_jerk = 1.0};
  EXPECT_EQ(words(), "jerk ");
  config.motion = {.max_yaw_rate = 0.01};
  EXPECT_EQ(words(), "yaw r");
}

TEST(FlightJudge, ComplainsOfAFlightThatJerksAtAJoint) {
  // Slow and straight, but in motion from the first moment; then over a corner without slowing.
  TrajectoryResult flown;
  flown.trajectory.segments = {piece(kStart, kGoal, 10.0)};
  EXPECT_EQ(complaint(flown).substr(0, 12), "acceleration");
  TrajectoryConfig moving{.radius = 0.3};
  moving.start_velocity = Point(0.4, 0.0, 0.0);
  const Point corner(3.05, 1.05, 1.05), aside(3.05, 1.45, 1.05);
  flown.trajectory.segments = {piece(kStart, corner, 5.0), piece(corner, aside, 1.0)};
  const FlightJudge judge(room(), UnknownPolicy::kObstacle);
  EXPECT_EQ(judge.judge(flown, kStart, aside, moving).complaint.substr(0, 12), "acceleration");
  flown.trajectory.segments = {piece(kStart, corner, 5.0), piece(aside, kGoal, 5.0)};
  EXPECT_EQ(complaint(flown), "jumps");
}

TEST(FlightJudge, ComplainsOfWhatIsInTheWay) {
  const TrajectoryResult flown = good_flight();
  EXPECT_EQ(complaint(flown, room(VoxelState::kOccupied)).substr(0, 8), "collides");
  EXPECT_EQ(complaint(flown, room(VoxelState::kUnknown)).substr(0, 8), "collides");
  EXPECT_EQ(complaint(flown, room(VoxelState::kUnknown), UnknownPolicy::kIgnore), "");
  TrajectoryResult through;
  through.trajectory = plain_spline(std::vector<Point>{kStart, kGoal}, {.radius = 0.3});
  EXPECT_EQ(complaint(through), "");
  EXPECT_EQ(complaint(through, room(VoxelState::kUnknown), UnknownPolicy::kIgnore),
            "leaves the known");
}

TEST(FlightJudge, ComplainsOfWrongEndsAndAClearanceTooGood) {
  const FlightJudge judge(room(), UnknownPolicy::kObstacle);
  TrajectoryResult flown = good_flight();
  EXPECT_EQ(judge.judge(flown, kGoal, kGoal, {.radius = 0.3}).complaint, "starts elsewhere");
  EXPECT_EQ(judge.judge(flown, kStart, kStart, {.radius = 0.3}).complaint, "ends elsewhere");
  flown.trajectory.segments.clear();
  EXPECT_EQ(complaint(flown), "no segments");
  TrajectoryResult close = good_flight();
  TrajectoryConfig wide{.radius = 0.58};  // of 0.6 m beside the stop
  EXPECT_EQ(judge.judge(close, kStart, kGoal, wide).complaint, "");
  close.clearance = 0.61;
  EXPECT_EQ(judge.judge(close, kStart, kGoal, wide).complaint.substr(0, 6), "states");
  EXPECT_THROW(FlightJudge({}, UnknownPolicy::kObstacle), InputError);
}

}  // namespace
}  // namespace ridgeway
