// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>
#include <ompl/util/Console.h>

#include <cmath>
#include <random>
#include <string>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "sampling/two_rooms.hpp"
#include "support/cancelling.hpp"

namespace ridgeway {
namespace {

using testing::iterations_of;
using testing::kForever;
using testing::kLeft;
using testing::kRadius;
using testing::kRight;
using testing::kSamplers;
using testing::limited;
using testing::two_rooms;

TEST(Sampling, EndsAreJudgedAsByEveryOtherPlanner) {
  const Roadmap roadmap = build_roadmap(two_rooms(false), {.min_clearance = kRadius}).roadmap;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-0.5, 6.5), y(-0.3, 4.3), z(-0.1, 2.1);
  std::array<int, 10> seen{};
  for (int i = 0; i < 200; ++i) {
    const Point start(x(random), y(random), z(random)), goal(x(random), y(random), z(random));
    const PlanStatus expected = plan(roadmap, start, goal, {.planner = Planner::kEsdf}).status;
    const Planner planner = kSamplers[static_cast<std::size_t>(i % 5)];
    SamplingConfig config = limited(planner, iterations_of(planner, 3000));
    config.first_solution = true;
    const SamplingResult result = plan_by_sampling(roadmap.esdf, start, goal, config);
    EXPECT_EQ(result.plan.status, expected);
    ++seen[static_cast<std::size_t>(expected)];
  }
  for (const PlanStatus status :
       {PlanStatus::kOk, PlanStatus::kStartOutsideMap, PlanStatus::kStartInCollision,
        PlanStatus::kGoalOutsideMap, PlanStatus::kGoalInCollision})
    EXPECT_GT(seen[static_cast<std::size_t>(status)], 0) << name_of(status);
}

TEST(Sampling, CanBeCancelledAsLongAsItSamples) {
  const EsdfMap esdf = compute_esdf(two_rooms(true));
  for (const Planner planner : kSamplers)
    for (const int stop : {0, 2})
      testing::expect_cancelled_at(stop, [&](const Progress& progress) {
        plan_by_sampling(esdf, kLeft, kRight,
                         {.planner = planner, .radius = kRadius, .time_limit = 1e9}, progress);
      });
}

TEST(Sampling, LeavesTheMessagesOfOmplToTheirOwner) {
  const EsdfMap esdf = compute_esdf(two_rooms(true));
  const auto* const before = ompl::msg::getOutputHandler();
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  for (const Planner planner : kSamplers)
    plan_by_sampling(esdf, kLeft, kRight, limited(planner, 50));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(ompl::msg::getOutputHandler(), before);
  EXPECT_NE(before, nullptr);
}

TEST(Sampling, TimeLimitEndsARoundOfManySmallMotions) {
  // RRT-Connect grows a tree all the way to the other one within a round: here by 100,000 motions,
  // each of which looks for the nearest of all before. That took minutes.
  const OccupancyMap corridor =
      testing::make_map(0.1, {0, 0, 0}, {9999, 11, 5}, [](const VoxelIndex& v) {
        return v.x == 500 && v.y < 6 ? VoxelState::kOccupied : VoxelState::kFree;
      });
  const EsdfMap esdf = compute_esdf(corridor, {});
  SamplingConfig config{.planner = Planner::kRrtConnect, .radius = 0.2, .time_limit = 0.2};
  config.range = 0.01;
  const SamplingResult result =
      plan_by_sampling(esdf, Point(1.0, 0.3, 0.3), Point(999.0, 0.3, 0.3), config);
  EXPECT_EQ(result.plan.status, PlanStatus::kTimeout);
  EXPECT_LT(result.plan.seconds.search, 10.0);
}

TEST(Sampling, RefusesBadConfigurations) {
  const EsdfMap esdf = compute_esdf(two_rooms(false), {.max_distance = 1.0});
  const auto expect_refused = [&](const SamplingConfig& config, const std::string& where) {
    try {
      plan_by_sampling(esdf, kLeft, kRight, config);
      ADD_FAILURE() << where << " was accepted";
    } catch (const InputError& error) {
      EXPECT_TRUE(error.where().starts_with(where)) << error.what();
    }
  };
  const double nan = std::nan("");
  const SamplingConfig good = limited(Planner::kRrtConnect, 100);
  const auto with = [&](auto SamplingConfig::*field, auto value) {
    SamplingConfig config = good;
    config.*field = value;
    return config;
  };
  expect_refused(with(&SamplingConfig::planner, Planner::kEsdf), "planner");
  for (const double radius : {0.0, -1.0, nan, kForever, 0.9})
    expect_refused(with(&SamplingConfig::radius, radius), "radius");
  for (const double limit : {0.0, -1.0, nan})
    expect_refused(with(&SamplingConfig::time_limit, limit), "time_limit");
  for (const double range : {-1.0, nan, kForever, 1e-4, 0.009, 1e-300})
    expect_refused(with(&SamplingConfig::range, range), "range");
  expect_refused(with(&SamplingConfig::iteration_limit, SamplingConfig{}.iteration_limit),
                 "time_limit");
  EXPECT_THROW(plan_by_sampling(esdf, Point(nan, 0, 0), kRight, good), InputError);
  EXPECT_THROW(PlanConfig{.planner = Planner::kRrtStar}.validate(), InputError);
}

}  // namespace
}  // namespace ridgeway
