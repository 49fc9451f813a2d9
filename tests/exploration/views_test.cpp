// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "exploration/views.hpp"

#include <gtest/gtest.h>

#include "ridgeway/live/live_roadmap.hpp"

namespace ridgeway {
namespace {

constexpr double kViewsVoxel = 0.2;
constexpr int kLength = 60;  // voxels of the hall along x

/// A free hall of 12 x 3 x 2.4 m.
std::vector<VoxelChange> hall() {
  std::vector<VoxelChange> changes;
  for (int z = -1; z <= 12; ++z)
    for (int y = -1; y <= 15; ++y)
      for (int x = -1; x <= kLength; ++x) {
        const bool is_wall = x < 0 || x == kLength || y < 0 || y == 15 || z < 0 || z == 12;
        changes.push_back({{x, y, z}, is_wall ? VoxelState::kOccupied : VoxelState::kFree});
      }
  return changes;
}

/// A cube of 4 voxels.
void add_cube(std::vector<VoxelChange>& changes, const VoxelIndex& low, VoxelState state) {
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) changes.push_back({low + VoxelIndex{x, y, z}, state});
}

std::vector<detail::Place> places_along_the_hall() {
  std::vector<detail::Place> places;
  for (int x = 3; x < kLength; x += 4) {
    const VoxelIndex voxel{x, 7, 6};
    places.push_back({places.size() + 1, voxel, centre_of(voxel, kViewsVoxel)});
  }
  return places;
}

/// Whether a part beyond three quarters of the hall is seen from somewhere.
bool sees_far(const detail::Views& views, const Frontiers& frontiers) {
  for (const auto& sights : views.from_places())
    for (const detail::Sight& sight : sights)
      if (frontiers.parts()[sight.part].centroid.x() > 0.75 * kLength * kViewsVoxel) return true;
  return false;
}

/// What is near is another in every update, and asks for more rays than there are.
TEST(Views, FarPartsAreSeenInTimeAndStaySeen) {
  LiveRoadmap live({.fusion = {.voxel_size = kViewsVoxel},
                    .build = {.min_clearance = 0.4, .max_distance = 2.0},
                    .origin = VoxelIndex{}});
  live.set_voxels(hall());
  const std::vector<detail::Place> places = places_along_the_hall();
  Frontiers frontiers;
  detail::Views views({}, 16, kAllVoxels, 0.0);
  std::vector<VoxelChange> changes;
  add_cube(changes, {52, 2, 2}, VoxelState::kUnknown);
  int first_seen = -1;
  for (int round = 0; round < 30; ++round) {
    for (int i = 0; i < 3; ++i) {
      if (round > 0) add_cube(changes, {4 + 8 * i + (round - 1) % 4, 9, 2}, VoxelState::kFree);
      add_cube(changes, {4 + 8 * i + round % 4, 9, 2}, VoxelState::kUnknown);
    }
    live.set_voxels(changes);
    changes.clear();
    frontiers.update(live.snapshot());
    const bool is_all =
        views.update(*live.snapshot(), frontiers, 1, places, places[0].position, 60, false);
    EXPECT_FALSE(is_all) << "the test asks for less than there is";
    if (first_seen < 0 && sees_far(views, frontiers)) first_seen = round;
    EXPECT_EQ(sees_far(views, frontiers), first_seen >= 0) << round;
  }
  EXPECT_GE(first_seen, 0);
  // The same as with all rays at once, when nothing changes.
  while (!views.update(*live.snapshot(), frontiers, 1, places, places[0].position, 60, false)) {
  }
  detail::Views anew({}, 16, kAllVoxels, 0.0);
  EXPECT_TRUE(
      anew.update(*live.snapshot(), frontiers, 1, places, places[0].position, 100'000, false));
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(views.from_places()[i].size(), anew.from_places()[i].size()) << i;
    for (std::size_t k = 0; k < anew.from_places()[i].size(); ++k) {
      EXPECT_EQ(views.from_places()[i][k].part, anew.from_places()[i][k].part);
      EXPECT_EQ(views.from_places()[i][k].rays.size(), anew.from_places()[i][k].rays.size());
    }
  }
}

/// A cube of unknown space at the far end, from places that all see its front at the same targets.
TEST(Views, LessIsExpectedFromFartherOff) {
  LiveRoadmap live({.fusion = {.voxel_size = kViewsVoxel},
                    .build = {.min_clearance = 0.4, .max_distance = 2.0},
                    .origin = VoxelIndex{}});
  std::vector<VoxelChange> changes = hall();
  add_cube(changes, {50, 5, 4}, VoxelState::kUnknown);
  live.set_voxels(changes);
  std::vector<detail::Place> places = places_along_the_hall();
  std::erase_if(places, [](const detail::Place& place) { return place.voxel.x > 35; });
  Frontiers frontiers;
  frontiers.update(live.snapshot());
  const FieldOfView view{.range = 10.0};
  detail::Views views(view, 16, kAllVoxels, 0.0);
  ASSERT_TRUE(
      views.update(*live.snapshot(), frontiers, 1, places, places[0].position, 100'000, true));
  const std::vector<std::uint64_t> nothing(views.parts(), 0);
  double gain_before = 0.0, now_before = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (views.from_places()[i].empty()) continue;
    const detail::Stop stop = views.best_heading(i, nothing);
    const double now =
        views.gain_now(*live.snapshot(), frontiers, 1, places[i], stop.heading);  // by samples
    EXPECT_GT(stop.gain, 1.05 * gain_before) << "from " << places[i].position.transpose();
    EXPECT_GT(now, 1.05 * now_before) << "from " << places[i].position.transpose();
    gain_before = stop.gain;
    now_before = now;
    ++compared;
  }
  EXPECT_GT(compared, 4);
}

}  // namespace
}  // namespace ridgeway
