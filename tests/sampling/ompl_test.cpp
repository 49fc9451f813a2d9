// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/sampling/ompl.hpp"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "sampling/two_rooms.hpp"

namespace ridgeway {
namespace {

namespace ob = ompl::base;
using testing::kLeft;
using testing::kRadius;
using testing::kRight;
using testing::two_rooms;

constexpr VoxelIndex kFarAway{4650000, 53000000, 0};  // as in UTM coordinates

Roadmap rooms_at(const VoxelIndex& origin) {
  OccupancyMap map = two_rooms(false);
  map.origin = map.origin + origin;
  return build_roadmap(std::move(map), {.min_clearance = kRadius}).roadmap;
}

ob::StateSpacePtr space_around(const Roadmap& roadmap) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  const Point low = to_world(roadmap.esdf, Point(-0.5, -0.5, -0.5));
  const Point high = to_world(roadmap.esdf, Point(6.5, 4.5, 2.5));
  bounds.low = {low.x(), low.y(), low.z()};
  bounds.high = {high.x(), high.y(), high.z()};
  space->setBounds(bounds);
  return space;
}

ob::ScopedState<ob::RealVectorStateSpace> state_at(const ob::StateSpacePtr& space, const Point& p) {
  ob::ScopedState<ob::RealVectorStateSpace> state(space);
  std::copy(p.begin(), p.end(), state->values);
  return state;
}

TEST(Ompl, JudgesStatesAndMotionsAsTheFreeSpacePredicate) {
  for (const VoxelIndex& origin : {VoxelIndex{}, kFarAway}) {
    const Roadmap roadmap = rooms_at(origin);
    const FreeSpace free(roadmap.esdf);
    const auto info = std::make_shared<ob::SpaceInformation>(space_around(roadmap));
    use_roadmap(info, roadmap, kRadius);
    info->setup();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(0.0, 6.0), y(0.0, 4.0), z(0.0, 2.0);
    int valid = 0, moved = 0, stopped = 0;
    for (int i = 0; i < 500; ++i) {
      const Point a(x(random), y(random), z(random)), b(x(random), y(random), z(random));
      const auto from = state_at(info->getStateSpace(), to_world(roadmap.esdf, a));
      const auto to = state_at(info->getStateSpace(), to_world(roadmap.esdf, b));
      ASSERT_EQ(info->isValid(from.get()), free.is_free(a, kRadius));
      ASSERT_NEAR(info->getStateValidityChecker()->clearance(from.get()), free.distance(a), 1e-7);
      if (!info->isValid(from.get())) continue;
      ++valid;
      auto last = state_at(info->getStateSpace(), Point::Zero());
      std::pair<ob::State*, double> last_valid{last.get(), 2.0};
      const bool is_free = info->checkMotion(from.get(), to.get(), last_valid);
      ASSERT_EQ(is_free, free.is_free(a, b, kRadius));
      ASSERT_EQ(info->checkMotion(from.get(), to.get()), is_free);
      ++(is_free ? moved : stopped);
      if (is_free) continue;
      ASSERT_GE(last_valid.second, 0.0);
      ASSERT_LT(last_valid.second, 1.0);
      EXPECT_TRUE(info->checkMotion(from.get(), last.get()));
    }
    EXPECT_GT(valid, 100);
    EXPECT_GT(moved, 50);
    EXPECT_GT(stopped, 50);
  }
}

TEST(Ompl, PlansWithAPlannerOfTheCallersOwn) {
  const Roadmap roadmap = rooms_at(kFarAway);
  ompl::geometric::SimpleSetup setup(space_around(roadmap));
  use_roadmap(setup.getSpaceInformation(), roadmap, kRadius);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  setup.setStartAndGoalStates(state_at(setup.getStateSpace(), to_world(roadmap.esdf, kLeft)),
                              state_at(setup.getStateSpace(), to_world(roadmap.esdf, kRight)));
  ASSERT_TRUE(setup.solve(10.0));
  std::vector<Point> path;
  const PlaceOf place_of = place_in_world(setup.getStateSpace(), roadmap.esdf);
  for (const ob::State* state : setup.getSolutionPath().getStates())
    path.push_back(place_of(state));
  EXPECT_GE(FreeSpace(roadmap.esdf).clearance(path), kRadius * (1.0 - 1e-6));
}

TEST(Ompl, InAPlaneHeightsPlayNoPart) {
  Roadmap roadmap = rooms_at({});
  const Point place(1.0, 1.0, 1.0);
  const auto info = std::make_shared<ob::SpaceInformation>(space_around(roadmap));
  const PlaceOf above = place_in_world(info->getStateSpace(), roadmap.esdf);
  roadmap.esdf.planar = true;
  const PlaceOf in_plane = place_in_world(info->getStateSpace(), roadmap.esdf);
  const auto state = state_at(info->getStateSpace(), place);
  EXPECT_EQ(above(state.get()), place);
  EXPECT_EQ(in_plane(state.get()), flight_place(roadmap.esdf, place));
  EXPECT_NE(in_plane(state.get()).z(), place.z());
}

TEST(Ompl, TakesPosesAndRefusesWhatItCannotPlace) {
  const Roadmap roadmap = rooms_at({});
  const auto poses = std::make_shared<ob::SE3StateSpace>();
  ob::ScopedState<ob::SE3StateSpace> pose(poses);
  pose->setXYZ(1.0, 2.0, 0.5);
  EXPECT_EQ(place_in_world(poses, roadmap.esdf)(pose.get()), Point(1.0, 2.0, 0.5));
  EXPECT_THROW(place_in_world(std::make_shared<ob::SE2StateSpace>(), roadmap.esdf), InputError);
  EXPECT_THROW(place_in_world(std::make_shared<ob::RealVectorStateSpace>(2), roadmap.esdf),
               InputError);
  const auto info = std::make_shared<ob::SpaceInformation>(space_around(roadmap));
  for (const double radius : {-0.1, std::nan("")})
    EXPECT_THROW(use_roadmap(info, roadmap, radius), InputError) << radius;
}

}  // namespace
}  // namespace ridgeway
