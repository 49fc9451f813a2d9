// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration/glances.hpp"

#include <gtest/gtest.h>

#include "ridgeway/live/live_roadmap.hpp"
#include "trajectory/shaped_trajectory.hpp"

namespace ridgeway {
namespace {

constexpr double kVoxel = 0.2;
constexpr double kFlightRate = 0.5 * std::numbers::pi;

/// A free room of 12 x 8 x 2.4 m with a cube of 0.8 m in it that is unknown, half way along x and
/// beside the middle; and places along the middle.
class Room {
 public:
  explicit Room(bool has_cube) {
    std::vector<VoxelChange> changes;
    for (int z = -1; z <= 12; ++z)
      for (int y = -1; y <= 40; ++y)
        for (int x = -1; x <= 60; ++x) {
          const bool is_wall = x < 0 || x == 60 || y < 0 || y == 40 || z < 0 || z == 12;
          const bool is_in_cube = x >= 28 && x < 32 && y >= 32 && y < 36 && z >= 4 && z < 8;
          if (has_cube && is_in_cube) continue;
          changes.push_back({{x, y, z}, is_wall ? VoxelState::kOccupied : VoxelState::kFree});
        }
    live_.set_voxels(changes);
    for (int x = 3; x < 60; x += 4) {
      const VoxelIndex voxel{x, 20, 6};
      places_.push_back({places_.size() + 1, voxel, centre_of(voxel, kVoxel)});
    }
    frontiers_.update(live_.snapshot());
    views_.update(*live_.snapshot(), frontiers_, 1, places_, places_[0].position, 100'000, false);
  }

  /// Along the middle, looking ahead, in so many seconds.
  Trajectory flight(double seconds) const {
    TrajectorySegment segment;
    segment.duration = seconds;
    const Point from = places_.front().position, to = places_.back().position;
    segment.coefficients.col(0).head<3>() = from;
    segment.coefficients.col(1).head<3>() = (to - from) / seconds;
    return {{segment}};
  }

  std::optional<double> yaw_in_flight(double seconds) const {
    const auto glances = detail::glances_along(flight(seconds), seconds, views_, places_, 0.8);
    EXPECT_GT(glances.size(), 3u);
    return detail::yaw_between(views_, 16, glances, 0.0, 0.0, seconds, kFlightRate);
  }

 private:
  LiveRoadmap live_{{.fusion = {.voxel_size = kVoxel},
                     .build = {.min_clearance = 0.4, .max_distance = 2.0},
                     .origin = VoxelIndex{}}};
  std::vector<detail::Place> places_;
  Frontiers frontiers_;
  detail::Views views_{{.horizontal = 0.6, .vertical = 1.2, .range = 5.0}, 16, kAllVoxels, 0.0};
};

TEST(Glances, OnTheWayTheRobotLooksAtWhatItPasses) {
  const auto yaw = Room(true).yaw_in_flight(6.0);
  ASSERT_TRUE(yaw);
  EXPECT_GT(*yaw, 0.3);  // ahead it would not see the cube, which is to the left
  EXPECT_LT(*yaw, 2.8);
}

TEST(Glances, WhereThereIsNothingToBeSeenItTurnsAtOnce) {
  EXPECT_FALSE(Room(false).yaw_in_flight(6.0));
}

TEST(Glances, WhereThereIsNoTimeToTurnBackItDoesNotLookElsewhere) {
  EXPECT_FALSE(Room(true).yaw_in_flight(1.2)) << "a heading that sees the cube takes longer";
}

}  // namespace
}  // namespace ridgeway
