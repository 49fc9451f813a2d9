// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/flights.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "ridgeway/common/error.hpp"
#include "support/cancelling.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

/// Two rooms of 4 x 4 x 2 m with a door between them, and a chamber without one.
OccupancyMap rooms() {
  return testing::make_map(0.1, {0, 0, 0}, {101, 40, 20}, [](const VoxelIndex& v) {
    const bool wall = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 101 || v.y == 40 || v.z == 20;
    const bool door = v.y > 10 && v.y < 22;
    return wall || (v.x == 40 && !door) || v.x == 81 ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(Flights, EveryPairThatAPathConnectsIsFlownWithoutAComplaint) {
  const FlightsConfig config{.queries = 30, .seed = 4};
  const FlightsResult result = run_flights(rooms(), config);
  ASSERT_EQ(result.flights.size(), 30u);
  EXPECT_EQ(result.solved, 30u);
  EXPECT_EQ(result.violations, 0u);
  EXPECT_EQ(result.longer_than_stop_and_go, 0u);
  EXPECT_EQ(std::accumulate(result.steps.begin(), result.steps.end(), std::size_t{0}), 30u);
  EXPECT_LE(result.over_bound.median, 1.35);
  EXPECT_GE(result.over_bound.median, 0.99);
  EXPECT_GT(result.plain_holds, 0u);
  for (const Flight& flight : result.flights) {
    EXPECT_GT(flight.path.size(), 1u);
    EXPECT_LE(flight.trapezoid_duration, flight.flown.stop_and_go_duration);
    EXPECT_GE(flight.verdict.clearance, config.min_clearance * (1 - 1e-6));
    EXPECT_GT(flight.plain_duration, 0.0);
  }
}

TEST(Flights, TheSameSeedFliesTheSame) {
  const FlightsResult first = run_flights(rooms(), {.queries = 3, .seed = 2});
  const FlightsResult again = run_flights(rooms(), {.queries = 3, .seed = 2});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(first.flights[i].path, again.flights[i].path);
    EXPECT_EQ(first.flights[i].flown.duration, again.flights[i].flown.duration);
  }
}

TEST(Flights, BadConfigurationsAreRefused) {
  EXPECT_THROW(run_flights(rooms(), {.min_clearance = 0.0}), InputError);
  EXPECT_THROW(run_flights(rooms(), {.queries = 0}), InputError);
  EXPECT_THROW(run_flights(rooms(), {.motion = {.max_speed = -1.0}}), InputError);
  EXPECT_THROW(run_flights(rooms(), {.min_clearance = 1.5}), InputError);  // fits nowhere
}

TEST(Flights, CanBeCancelled) {
  const auto flying = [](const Progress& progress) {
    run_flights(rooms(), {.queries = 3}, progress);
  };
  for (const int stop : {0, 1, 9, 10}) testing::expect_cancelled_at(stop, flying);
}

}  // namespace
}  // namespace ridgeway
