// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/blocked_route.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"
#include "support/random_limits.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::depth;
using testing::random_limits;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

FlightLimits band(double low, double high) {
  FlightLimits limits;
  limits.keep_in.min.z() = low;
  limits.keep_in.max.z() = high;
  return limits;
}

Point random_point(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> value(low, high);
  const double x = value(random), y = value(random), z = value(random);
  return {x, y, z};
}

Box random_box(std::mt19937& random, double low, double high) {
  const Point a = random_point(random, low, high), b = random_point(random, low, high);
  return {a.cwiseMin(b), a.cwiseMax(b) + Point::Constant(0.02)};
}

/// How deep at the deepest of many points along a segment.
double deepest(const Box& box, const Point& a, const Point& b) {
  double most = -kInfinity;
  for (int k = 0; k <= 2000; ++k) most = std::max(most, depth(box, a + (b - a) * (k / 2000.0)));
  return most;
}

TEST(FlightLimits, AllowASegmentWhereEveryPlaceOfItIs) {
  std::mt19937 random(1);
  int allowed = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    FlightLimits limits;
    limits.keep_in = random_box(random, -1.5, 1.5);
    limits.keep_out = {random_box(random, -0.5, 0.5), random_box(random, -0.5, 0.5)};
    Point a = random_point(random, -1.0, 1.0), b = random_point(random, -1.0, 1.0);
    if (i % 3 == 0) b = a;
    if (i % 3 == 1) b.z() = a.z();
    const double in = std::min(depth(limits.keep_in, a), depth(limits.keep_in, b));
    const double out =
        std::max(deepest(limits.keep_out[0], a, b), deepest(limits.keep_out[1], a, b));
    const double step = (b - a).norm() / 2000.0;
    if (in > 1e-6 && out < -step) {
      EXPECT_TRUE(limits.allow(a, b)) << i;
      ++allowed;
    } else if (in < -1e-6 || out > 1e-6) {
      EXPECT_FALSE(limits.allow(a, b)) << i;
      ++refused;
    }
  }
  EXPECT_GT(allowed, 100);
  EXPECT_GT(refused, 1000);
}

TEST(FlightLimits, FacesAreWithinAndInsidesOfKeepOutAreNot) {
  FlightLimits limits = band(0.5, 1.5);
  limits.keep_out = {{Point(0, 0, 0), Point(1, 1, 1)}};
  EXPECT_TRUE(limits.allow(Point(-1, 0.5, 0.5), Point(0, 0.5, 1.5)));  // up to a face
  EXPECT_TRUE(limits.allow(Point(-1, 0.5, 1), Point(2, 0.5, 1)));      // along the top
  EXPECT_TRUE(limits.allow(Point(-1, 1, 0.7), Point(2, 1, 0.7)));      // along a side
  EXPECT_TRUE(limits.allow(Point(-1, 1, 0.7), Point(1, -1, 0.7)));     // over an edge
  EXPECT_FALSE(limits.allow(Point(-1, 0.5, 0.999), Point(2, 0.5, 0.999)));
  EXPECT_FALSE(limits.allow(Point(-1, -1, 1.5 + 1e-6)));
  EXPECT_FALSE(FlightLimits{}.any());
  EXPECT_TRUE(limits.any());
}

TEST(FlightLimits, BadOnesAreRefused) {
  const auto refusal = [](const FlightLimits& limits) {
    try {
      limits.validate();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(band(1.0, 0.5)).find("keep_in"), std::string::npos);
  EXPECT_NE(refusal(band(nan, 0.5)).find("keep_in"), std::string::npos);
  EXPECT_NE(refusal(band(kInfinity, kInfinity)).find("keep_in"), std::string::npos);
  FlightLimits flat;
  flat.keep_out = {{Point(0, 0, 0), Point(1, 1, 1)}, {Point(0, 0, 0), Point(1, 1, 0)}};
  EXPECT_NE(refusal(flat).find("keep_out box 2"), std::string::npos);
  EXPECT_EQ(refusal(band(0.5, 0.5)), "");
}

/// What A* through the ESDF has to find, by flooding: voxels of the oracle's own making.
class Judge {
 public:
  Judge(const EsdfMap& esdf, const FlightLimits& limits, double radius)
      : esdf_(esdf), free_(esdf), threshold_(least_clearance(radius, esdf.voxel_size)) {
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (esdf.is_open(id) && esdf.squared[id] >= threshold_ &&
          testing::is_within(limits, esdf.layout.index_of(id), esdf.voxel_size))
        places_.push_back(id);
    for (const VoxelId id : places_) within_.insert(id);
  }

  const std::vector<VoxelId>& places() const { return places_; }

  bool connects(VoxelId from, VoxelId to) const {
    std::set<VoxelId> seen{from};
    std::vector<VoxelId> open{from};
    while (!open.empty()) {
      const VoxelId here = open.back();
      open.pop_back();
      if (here == to) return true;
      for (int d = 0; d < 27; ++d) {
        const VoxelId next = esdf_.layout.neighbour(here, d);
        if (d != kCentre && next != kNoVoxel && within_.contains(next) && !seen.contains(next) &&
            free_.move_is_free(here, next, d, threshold_)) {
          seen.insert(next);
          open.push_back(next);
        }
      }
    }
    return false;
  }

 private:
  const EsdfMap& esdf_;
  const FreeSpace free_;
  const SquaredHalves threshold_;
  std::vector<VoxelId> places_;
  std::set<VoxelId> within_;
};

void expect_within(const FlightLimits& limits, const std::vector<Point>& path) {
  for (std::size_t i = 1; i < path.size(); ++i)
    for (int k = 0; k <= 100; ++k) {
      const Point p = path[i - 1] + (path[i] - path[i - 1]) * (k / 100.0);
      ASSERT_GE(depth(limits.keep_in, p), -2e-8);
      for (const Box& box : limits.keep_out) ASSERT_LE(depth(box, p), 2e-8);
    }
}

struct Answers {
  int routes = 0, none = 0;
  int by_lines = 0;  ///< routes where no moves between voxels lead from end to end
};

/// Plans between random places; answers must be the judge's, and paths keep the limits. But
/// straight lines of the graph, and corners that see each other, may lead where no moves between
/// voxels do.
void judge_plans(const Roadmap& roadmap, const FlightLimits& limits, const PlanConfig& config,
                 unsigned seed, Answers& answers) {
  const Judge judge(roadmap.esdf, limits, roadmap.min_clearance);
  if (judge.places().empty()) return;
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf, limits);
  std::mt19937 random(seed);
  for (int i = 0; i < 6; ++i) {
    const VoxelId from = judge.places()[random() % judge.places().size()];
    const VoxelId to = judge.places()[random() % judge.places().size()];
    const Point start = centre_of(esdf.layout.index_of(from), esdf.voxel_size);
    const Point goal = centre_of(esdf.layout.index_of(to), esdf.voxel_size);
    for (const Planner planner :
         {Planner::kGraph, Planner::kDiagram, Planner::kEsdf, Planner::kThetaStar}) {
      PlanConfig asked = config;
      asked.planner = planner;
      const PlanResult result = plan(roadmap, start, goal, asked);
      const bool straight = space.is_free(start, goal, roadmap.min_clearance);
      if (straight || judge.connects(from, to)) {
        ASSERT_TRUE(result.ok()) << name_of(planner);
      } else if (result.ok()) {
        ASSERT_EQ(planner, Planner::kGraph);
        ++answers.by_lines;
      }
      if (!result.ok()) ASSERT_EQ(result.status, PlanStatus::kNoRoute);
      result.ok() ? ++answers.routes : ++answers.none;
      expect_within(limits, result.waypoints);
      const FlightLimits none;
      const FreeSpace anywhere(esdf, none);
      for (std::size_t k = 1; k < result.waypoints.size(); ++k)
        ASSERT_TRUE(
            anywhere.is_free(result.waypoints[k - 1], result.waypoints[k], roadmap.min_clearance));
    }
  }
}

TEST(PlanWithinLimits, FindsAPathWhereVoxelsWithinThemAreConnected) {
  Answers asked, built;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const OccupancyMap map = testing::random_map(seed, 20);
    std::mt19937 random(seed);
    const FlightLimits limits = random_limits(random, *known_bounds(map));
    try {
      const BuildConfig config{.min_clearance = 0.1, .unknown = policy, .tangent_pairs = 100};
      const Roadmap roadmap = build_roadmap(map, config).roadmap;
      judge_plans(roadmap, limits, {.limits = limits}, seed, asked);
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    try {
      const BuildConfig config{
          .min_clearance = 0.1, .unknown = policy, .limits = limits, .tangent_pairs = 100};
      const Roadmap roadmap = build_roadmap(map, config).roadmap;
      judge_plans(roadmap, limits, {}, seed, built);
    } catch (const InputError&) {
      continue;  // nor within the limits
    }
  }
  EXPECT_GT(asked.routes, 200);
  EXPECT_GT(asked.none, 20);
  EXPECT_GT(built.routes, 200);
  EXPECT_GT(built.none, 20);
  EXPECT_LT(asked.by_lines, asked.routes / 50);
  EXPECT_EQ(built.by_lines, 0);
}

/// A room 6 x 3 x 2 m, with a wall at x = 3 that leaves a gap below the ceiling.
OccupancyMap room_with_a_gap_above() {
  return testing::make_map(0.1, {0, 0, 0}, {61, 31, 21}, [](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.y == 0 || v.z == 0 || v.x == 61 || v.y == 31 || v.z == 21;
    const bool wall = (v.x == 30 || v.x == 31) && v.z < 12;
    return hull || wall ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(PlanWithinLimits, SaysThatLimitsAreInTheWay) {
  const Roadmap roadmap = build_roadmap(room_with_a_gap_above(), {.min_clearance = 0.3}).roadmap;
  const Point start(1, 1.5, 0.8), goal(5, 1.5, 0.8);
  ASSERT_TRUE(plan(roadmap, start, goal).ok());
  const FlightLimits low = band(0.4, 1.2);
  EXPECT_EQ(plan(roadmap, start, goal, {.limits = low}).status, PlanStatus::kNoRoute);
  const auto blocked = RouteBlocks(roadmap).between(start, goal, 0.3, low);
  ASSERT_TRUE(blocked);
  EXPECT_EQ(blocked->by, Blocker::kLimits);
  EXPECT_EQ(name_of(blocked->by), "limits");
  EXPECT_EQ(plan(roadmap, start, Point(5, 1.5, 1.6), {.limits = low}).status,
            PlanStatus::kGoalOutsideLimits);
  EXPECT_EQ(plan(roadmap, Point(1, 1.5, 1.6), goal, {.limits = low}).status,
            PlanStatus::kStartOutsideLimits);
  // Of the map itself: the same, though its graph never was beyond them.
  const Roadmap limited =
      build_roadmap(room_with_a_gap_above(), {.min_clearance = 0.3, .limits = low}).roadmap;
  EXPECT_EQ(plan(limited, start, goal).status, PlanStatus::kNoRoute);
  EXPECT_EQ(RouteBlocks(limited).between(start, goal, 0.3)->by, Blocker::kLimits);
  EXPECT_THROW(plan(roadmap, start, goal, {.limits = band(0.41, 0.42)}), InputError);
  EXPECT_THROW(build_roadmap(room_with_a_gap_above(), {.limits = band(0.41, 0.42)}), InputError);
}

TEST(PlanWithinLimits, ABandIsNoWall) {
  // 0.6 m high, less than two radii: walls there would leave no room at all.
  std::vector<Eigen::Vector2d> axes;
  const OccupancyMap map = testing::make_map(
      0.1, {0, 0, 0}, {79, 59, 19}, [&, pillars = testing::pillars(3, axes)](const VoxelIndex& v) {
        if (v.z == 0 || v.z == 19) return VoxelState::kOccupied;
        return pillars.at({v.x, v.y, 3});
      });
  const FlightLimits limits = band(0.7, 1.0);
  const BuildConfig config{.min_clearance = 0.4, .limits = limits};
  const Roadmap within = build_roadmap(map, config).roadmap;
  const Roadmap everywhere = build_roadmap(map, {.min_clearance = 0.4}).roadmap;
  EXPECT_GT(within.graph.edges.size(), 4u);
  for (const Vertex& vertex : within.graph.vertices) EXPECT_TRUE(limits.allow(vertex.position));
  const CheckReport built = check_roadmap(within, {.queries = 150});
  EXPECT_TRUE(built.is_clean());
  EXPECT_EQ(built.graph_ok, built.queries);
  EXPECT_LT(built.fallbacks, built.queries / 20);
  const CheckReport asked = check_roadmap(everywhere, {.queries = 150, .limits = limits});
  EXPECT_TRUE(asked.is_clean());
  EXPECT_EQ(asked.graph_ok, asked.queries);
  EXPECT_LT(asked.fallbacks, asked.queries / 5);  // the graph moved into the band mostly answers
  for (const CheckReport* report : {&built, &asked})
    for (const CheckedPath& path : report->paths) expect_within(limits, path.waypoints);
}

/// A room with voxels that are occupied here and there.
OccupancyMap room_of_specks(unsigned seed) {
  std::mt19937 random(seed);
  return testing::make_map(0.1, {0, 0, 0}, {59, 49, 15}, [&](const VoxelIndex& v) {
    const bool hull = v.x == 0 || v.x == 59 || v.y == 0 || v.y == 49 || v.z == 0 || v.z == 15;
    return hull || random() % 700 == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

// In a band two voxels high there are ways that moves between voxels do not have. To find them is
// no fault of a roadmap; to miss what A* finds is one.
TEST(PlanWithinLimits, MoreMayBeFoundThanMovesBetweenVoxelsHave) {
  std::size_t found = 0, found_by_moves = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Roadmap roadmap = build_roadmap(room_of_specks(seed), {.min_clearance = 0.25}).roadmap;
    const FlightLimits limits = band(0.69, 0.89);
    const CheckReport report =
        check_roadmap(roadmap, {.queries = 60, .seed = seed, .limits = limits});
    EXPECT_TRUE(report.is_clean()) << seed;
    EXPECT_GE(report.graph_ok, report.esdf_ok) << seed;
    for (const CheckedPath& path : report.paths) expect_within(limits, path.waypoints);
    found += report.graph_ok;
    found_by_moves += report.esdf_ok;
  }
  EXPECT_GT(found, found_by_moves);
}

TEST(PlanWithinLimits, AlternativesKeepThem) {
  std::vector<Eigen::Vector2d> axes;
  const Roadmap roadmap =
      build_roadmap(testing::pillars(5, axes), {.min_clearance = testing::kPillarClearance})
          .roadmap;
  FlightLimits limits;
  limits.keep_out = {{Point(3.5, 2.0, -1.0), Point(4.5, 4.0, 2.0)}};
  const Alternatives found =
      plan_alternatives(roadmap, Point(0.5, 3, 0.4), Point(7.5, 3, 0.4), 4, {.limits = limits});
  ASSERT_TRUE(found.ok());
  EXPECT_GT(found.routes.size(), 1u);
  for (const PlanResult& route : found.routes) expect_within(limits, route.waypoints);
}

TEST(PlanWithinLimits, AShiftOfMapAndLimitsShiftsThePath) {
  OccupancyMap near = room_with_a_gap_above(), far = near;
  const VoxelIndex shift{4'650'000, 53'000'000, -3'000};
  far.origin = shift;
  FlightLimits limits;
  limits.keep_in = {Point(0.4, 0.4, 0.4), Point(6.0, 2.0, 1.8)};
  limits.keep_out = {{Point(2.5, 0.0, 0.0), Point(3.7, 1.3, 2.0)}};
  const Point offset = Point(shift.x, shift.y, shift.z) * 0.1;
  FlightLimits far_limits;
  far_limits.keep_in = {limits.keep_in.min + offset, limits.keep_in.max + offset};
  far_limits.keep_out = {{limits.keep_out[0].min + offset, limits.keep_out[0].max + offset}};
  const auto path = [](const OccupancyMap& map, const FlightLimits& built,
                       const FlightLimits& asked, const Point& at) {
    const Roadmap roadmap = build_roadmap(map, {.min_clearance = 0.3, .limits = built}).roadmap;
    return plan(roadmap, at + Point(1, 1, 0.8), at + Point(5, 1, 0.8), {.limits = asked}).waypoints;
  };
  for (const bool at_build : {true, false}) {
    const auto here = path(near, at_build ? limits : FlightLimits{},
                           at_build ? FlightLimits{} : limits, Point::Zero());
    const auto there = path(far, at_build ? far_limits : FlightLimits{},
                            at_build ? FlightLimits{} : far_limits, offset);
    ASSERT_GT(here.size(), 2u);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i)
      EXPECT_LT((there[i] - offset - here[i]).norm(), 5e-8);
  }
}

}  // namespace
}  // namespace ridgeway
