// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/blocked_route.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/brute_force.hpp"
#include "support/flood.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kBlockedVoxel = 0.1, kBlockedRadius = 0.1;

/// The widest way between two voxels by a plain search: Prim's, over every legal move.
double bottleneck(const EsdfMap& esdf, VoxelId from, VoxelId to) {
  const FreeSpace space(esdf);
  const auto at = [&](VoxelId id) { return static_cast<double>(esdf.squared[id]); };
  std::set<VoxelId> done;
  std::set<std::pair<double, VoxelId>> open{{-at(from), from}};
  while (!open.empty()) {
    const auto [negative, id] = *open.begin();
    open.erase(open.begin());
    if (!done.insert(id).second) continue;
    if (id == to) return 0.5 * esdf.voxel_size * std::sqrt(-negative);
    for (int d = 0; d < 27; ++d) {
      const VoxelId next = esdf.layout.neighbour(id, d);
      if (d == kCentre || next == kNoVoxel || !esdf.is_open(next)) continue;
      const double width = std::min({-negative, at(next), space.move_clearance(id, next, d).value});
      if (width > 0.0 && !done.contains(next)) open.insert({-width, next});
    }
  }
  return 0.0;
}

/// Whether face moves over all that is not occupied join two voxels: inside the box around all that
/// is known, or all around it too.
bool joined_but_for_occupied(const OccupancyMap& map, const VoxelIndex& from, const VoxelIndex& to,
                             bool is_inside = true) {
  const VoxelRange reach = grown(known_range(map), is_inside ? 0 : 1);
  std::set<VoxelIndex> seen{from};
  std::vector<VoxelIndex> open{from};
  while (!open.empty()) {
    const VoxelIndex v = open.back();
    open.pop_back();
    if (v == to) return true;
    for (const VoxelIndex& step :
         {VoxelIndex{1, 0, 0}, VoxelIndex{-1, 0, 0}, VoxelIndex{0, 1, 0}, VoxelIndex{0, -1, 0},
          VoxelIndex{0, 0, 1}, VoxelIndex{0, 0, -1}}) {
      const VoxelIndex next = v + step;
      if (!reach.contains(next)) continue;
      if (map.at(next) != VoxelState::kOccupied && seen.insert(next).second) open.push_back(next);
    }
  }
  return false;
}

struct Tally {
  int narrow = 0, never = 0, by_unknown = 0, enclosed = 0, beyond = 0;
};

void expect_explained(const Roadmap& roadmap, const OccupancyMap& map, const RouteBlocks& blocks,
                      VoxelId from, VoxelId to, double radius, const testing::Regions& regions,
                      Tally& tally) {
  const EsdfMap& esdf = roadmap.esdf;
  const auto place_of = [&](VoxelId id) {
    return centre_of(esdf.layout.index_of(id), kBlockedVoxel);
  };
  ASSERT_EQ(plan(roadmap, place_of(from), place_of(to), {.radius = radius}).status,
            PlanStatus::kNoRoute);
  const auto blocked = blocks.between(place_of(from), place_of(to), radius);
  ASSERT_TRUE(blocked.has_value());
  EXPECT_NEAR(blocked->radius, bottleneck(esdf, from, to), 1e-9);
  EXPECT_LT(blocked->radius, radius);
  std::map<std::uint32_t, std::size_t> sizes;
  for (const auto& [id, label] : regions.label) ++sizes[label];
  EXPECT_EQ(blocked->start_component.voxels, sizes[regions.label.at(from)]);
  EXPECT_EQ(blocked->goal_component.voxels, sizes[regions.label.at(to)]);
  EXPECT_NE(blocked->start_number, blocked->goal_number);
  const auto nearest = [&](VoxelState state) {
    double best = std::numeric_limits<double>::infinity();
    const VoxelIndex at = voxel_at(*blocked->place, kBlockedVoxel);
    for (int z = -20; z <= 20; ++z)
      for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x)
          if (const VoxelIndex v = at + VoxelIndex{x, y, z}; map.at(v) == state)
            best = std::min(best,
                            testing::brute_squared_distance(*blocked->place / kBlockedVoxel, {v}));
    return best;
  };
  if (blocked->radius > 0.0) {
    ++tally.narrow;
    ASSERT_TRUE(blocked->place.has_value());
    // The narrowest place is as wide as the radius says, unless a diagonal move dips beside it.
    const double there = FreeSpace(esdf).distance(*blocked->place);
    EXPECT_GE(there, blocked->radius - 1e-9);
    EXPECT_LE(there, blocked->radius + kBlockedVoxel);
    tally.by_unknown += blocked->by == Blocker::kUnknown;
    if (there > blocked->radius + 1e-9) return;
    const bool is_unknown = esdf.unknown == UnknownPolicy::kObstacle &&
                            nearest(VoxelState::kUnknown) < nearest(VoxelState::kOccupied) - 1e-9;
    EXPECT_EQ(blocked->by == Blocker::kUnknown, is_unknown);
    return;
  }
  ++tally.never;
  const bool joined =
      joined_but_for_occupied(map, esdf.layout.index_of(from), esdf.layout.index_of(to));
  EXPECT_EQ(blocked->by == Blocker::kUnknown, joined);
  EXPECT_EQ(blocked->place.has_value(), joined);
  const bool joined_beyond =
      joined_but_for_occupied(map, esdf.layout.index_of(from), esdf.layout.index_of(to), false);
  EXPECT_EQ(blocked->map_end.has_value(), joined_beyond && !joined);
  tally.enclosed += !joined_beyond;
  tally.beyond += joined_beyond && !joined;
  if (blocked->map_end) {
    EXPECT_FALSE(known_range(map).contains(voxel_at(*blocked->map_end, kBlockedVoxel)));
  }
  if (!joined) return;
  const VoxelIndex gate = voxel_at(*blocked->place, kBlockedVoxel);
  EXPECT_EQ(map.at(gate), VoxelState::kUnknown);
  EXPECT_TRUE(joined_but_for_occupied(map, gate, esdf.layout.index_of(to)));
}

TEST(BlockedRoute, TellsTheWidestWayByBruteForceAndWhatIsInIt) {
  Tally tally;
  for (unsigned seed = 0; seed < 75; ++seed) {
    SCOPED_TRACE(seed);
    constexpr auto kUsual = UnknownPolicy::kObstacle;
    const auto policy =
        std::array{UnknownPolicy::kIgnore, kUsual, kUsual, UnknownPolicy::kFree, kUsual}[seed % 5];
    const OccupancyMap map = testing::random_map(seed, 20, kBlockedVoxel);
    const EsdfMap esdf = compute_esdf(map, {.unknown = policy});
    if (testing::traversable_places(esdf, kBlockedRadius).empty()) continue;
    const Roadmap roadmap =
        build_roadmap(map, {.min_clearance = kBlockedRadius, .unknown = policy}).roadmap;
    const RouteBlocks blocks(roadmap);
    for (const double radius : {kBlockedRadius, 0.15, 0.2}) {  // the built radius too
      const testing::Regions regions = testing::regions_at(roadmap.esdf, radius);
      for (std::size_t a = 0; a < std::min<std::size_t>(regions.first.size(), 4); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          expect_explained(roadmap, map, blocks, regions.first[a], regions.first[b], radius,
                           regions, tally);
          if (::testing::Test::HasFatalFailure()) return;
        }
    }
  }
  EXPECT_GT(tally.narrow, 50);
  EXPECT_GT(tally.never, 20);
  EXPECT_GT(tally.by_unknown, 10);
  EXPECT_GT(tally.beyond, 0);
}

/// Two rooms_with_window with a window in the wall between them, 4 voxels wide and high; `filling`:
/// the wall.
OccupancyMap rooms_with_window(VoxelState filling, VoxelState window_state = VoxelState::kFree) {
  return testing::make_map(kBlockedVoxel, {0, 0, 0}, {61, 23, 23}, [=](const VoxelIndex& v) {
    if (v.x == 0 || v.y == 0 || v.z == 0 || v.x == 61 || v.y == 23 || v.z == 23)
      return VoxelState::kOccupied;
    const bool wall = v.x == 30 || v.x == 31;
    const bool window = v.y >= 10 && v.y <= 13 && v.z >= 10 && v.z <= 13;
    return wall ? (window ? window_state : filling) : VoxelState::kFree;
  });
}

TEST(BlockedRoute, NamesTheWindowAndWhetherItsFrameIsKnown) {
  const Point start(1.0, 1.0, 1.0), goal(5.0, 1.0, 1.0);
  for (const VoxelState frame : {VoxelState::kOccupied, VoxelState::kUnknown}) {
    const Roadmap roadmap = build_roadmap(rooms_with_window(frame), {.min_clearance = 0.3}).roadmap;
    ASSERT_EQ(plan(roadmap, start, goal).status, PlanStatus::kNoRoute);
    const auto blocked = RouteBlocks(roadmap).between(start, goal, 0.3);
    ASSERT_TRUE(blocked.has_value());
    EXPECT_NEAR(blocked->radius, 0.15, 1e-12);
    EXPECT_NEAR(blocked->place->x(), 3.1, 0.2);
    EXPECT_NEAR(blocked->place->y(), 1.2, 0.15);
    EXPECT_EQ(blocked->by, frame == VoxelState::kUnknown ? Blocker::kUnknown : Blocker::kObstacle);
    EXPECT_EQ(blocked->start_number + blocked->goal_number, 1u);
    const Roadmap smaller =
        build_roadmap(rooms_with_window(frame), {.min_clearance = blocked->radius}).roadmap;
    EXPECT_TRUE(plan(smaller, start, goal).ok());
  }
}

TEST(BlockedRoute, TellsUnknownSpaceFromWallsWhereNoRadiusHelps) {
  const Point start(1.0, 1.0, 1.0), goal(5.0, 1.0, 1.0);
  for (const VoxelState window : {VoxelState::kOccupied, VoxelState::kUnknown})
    for (const UnknownPolicy policy : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore}) {
      const Roadmap roadmap = build_roadmap(rooms_with_window(VoxelState::kOccupied, window),
                                            {.min_clearance = 0.1, .unknown = policy})
                                  .roadmap;
      const auto blocked = RouteBlocks(roadmap).between(start, goal, 0.1);
      ASSERT_TRUE(blocked.has_value());
      EXPECT_EQ(blocked->radius, 0.0);
      ASSERT_EQ(blocked->place.has_value(), window == VoxelState::kUnknown);
      if (!blocked->place) {
        EXPECT_EQ(blocked->by, Blocker::kObstacle);
        continue;
      }
      EXPECT_EQ(blocked->by, Blocker::kUnknown);
      EXPECT_NEAR(blocked->place->x(), 3.05, 1e-9);  // the window, from the start's side
      EXPECT_NEAR(blocked->place->y(), 1.2, 0.2);
    }
}

/// A box that a wall cuts right through, with nothing known beyond its sides.
OccupancyMap cut_box(VoxelState corner, const VoxelIndex& low = {0, 0, 0}) {
  return testing::make_map(kBlockedVoxel, low, low + VoxelIndex{41, 21, 21},
                           [=](const VoxelIndex& at) {
                             const VoxelIndex v = at - low;
                             if (v.y > 18 && v.z > 18) return corner;
                             return v.x == 20 ? VoxelState::kOccupied : VoxelState::kFree;
                           });
}

TEST(BlockedRoute, NamesTheWallWhereTheOnlyOtherWayLeavesTheMap) {
  const Point start(1.0, 1.0, 1.0), goal(3.0, 1.0, 1.0);
  for (const UnknownPolicy policy : {UnknownPolicy::kObstacle, UnknownPolicy::kIgnore})
    for (const VoxelState corner : {VoxelState::kOccupied, VoxelState::kUnknown}) {
      const OccupancyMap map = cut_box(corner);
      const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.3, .unknown = policy}).roadmap;
      const auto blocked = RouteBlocks(roadmap).between(start, goal, 0.3);
      ASSERT_TRUE(blocked.has_value());
      EXPECT_EQ(blocked->radius, 0.0);
      const bool passes_inside = corner == VoxelState::kUnknown;
      EXPECT_EQ(blocked->by, passes_inside ? Blocker::kUnknown : Blocker::kObstacle);
      ASSERT_EQ(blocked->place.has_value(), passes_inside);
      ASSERT_EQ(blocked->map_end.has_value(), !passes_inside);
      if (passes_inside) {
        EXPECT_TRUE(known_range(map).contains(voxel_at(*blocked->place, kBlockedVoxel)));
      } else {
        EXPECT_FALSE(known_range(map).contains(voxel_at(*blocked->map_end, kBlockedVoxel)));
        EXPECT_LT(blocked->map_end->x(), 2.0);  // on the start's side
      }
    }
}

TEST(BlockedRoute, LeavesBadPlacesToThePlan) {
  const Roadmap roadmap =
      build_roadmap(rooms_with_window(VoxelState::kOccupied), {.min_clearance = 0.3}).roadmap;
  const RouteBlocks blocks(roadmap);
  EXPECT_FALSE(blocks.between(Point(-9, 0, 0), Point(5, 1, 1), 0.3).has_value());
  EXPECT_FALSE(blocks.between(Point(5, 1, 1), Point(0.15, 1, 1), 0.3).has_value());
}

TEST(BlockedRoute, RefusesRadiiThatAreNone) {
  const Roadmap roadmap =
      build_roadmap(testing::random_map(1, 16), {.min_clearance = kBlockedRadius}).roadmap;
  const RouteBlocks blocks(roadmap);
  for (const double radius :
       {-1.0, 0.0, -1e308, std::nan(""), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()})
    EXPECT_THROW(blocks.between(Point(1, 1, 1), Point(2, 1, 1), radius), InputError) << radius;
}

}  // namespace
}  // namespace ridgeway
