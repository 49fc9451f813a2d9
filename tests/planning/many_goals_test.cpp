// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/many_goals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/dijkstra.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kGoalsClearance = 0.1;

std::optional<Roadmap> roadmap_with_room(unsigned seed) {
  try {
    return build_roadmap(testing::random_map(seed, 24), {.min_clearance = kGoalsClearance}).roadmap;
  } catch (const InputError&) {
    return std::nullopt;  // no room in this one
  }
}

/// The first is a start. One is outside, the others may be out of reach.
std::vector<Point> random_places(const Roadmap& roadmap, unsigned seed) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::vector<VoxelId> places = testing::traversable_places(esdf, kGoalsClearance);
  std::mt19937 random(seed);
  std::vector<Point> points;
  points.reserve(11);
  for (int i = 0; i < 10; ++i)
    points.push_back(
        centre_of(esdf.layout.index_of(places[random() % places.size()]), esdf.voxel_size));
  points.emplace_back(100, 0, 0);
  return points;
}

/// Calls body(roadmap, start, goals) on random maps.
template <typename Body>
void on_random_roadmaps(const Body& body) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const std::optional<Roadmap> roadmap = roadmap_with_room(seed);
    if (!roadmap) continue;
    const std::vector<Point> places = random_places(*roadmap, seed);
    body(*roadmap, places[0], std::span(places).subspan(1));
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(ManyGoals, AreReachedAsSinglePlansReachThem) {
  int reached = 0, refused = 0;
  on_random_roadmaps([&](const Roadmap& roadmap, const Point& start, std::span<const Point> goals) {
    for (const double radius : {kGoalsClearance, 0.15}) {
      const PlanConfig config{.radius = radius};
      const std::vector<GoalPlan> many = plan_to_many(roadmap, start, goals, config);
      const NearestGoal nearest = plan_to_nearest(roadmap, start, goals, config);
      ASSERT_EQ(many.size(), goals.size());
      std::optional<std::size_t> best;
      for (std::size_t i = 0; i < goals.size(); ++i) {
        const PlanResult single = plan(roadmap, start, goals[i], config);
        EXPECT_EQ(many[i].plan.status, single.status);
        EXPECT_EQ(many[i].plan.waypoints, single.waypoints);
        if (nearest.statuses[i]) {
          EXPECT_EQ(*nearest.statuses[i], single.status);
        }
        if (single.ok() && (!best || single.length < many[*best].plan.length)) best = i;
        ++(single.ok() ? reached : refused);
      }
      EXPECT_EQ(nearest.goal, best);
      EXPECT_EQ(nearest.plan.ok(), best.has_value());
      EXPECT_EQ(nearest.plan.waypoints, many[best.value_or(0)].plan.waypoints);
    }
  });
  EXPECT_GT(reached, 200);
  EXPECT_GT(refused, 100);
}

TEST(ManyGoals, DistancesAreThoseOfRawPlansAndOfDijkstra) {
  int compared = 0, over_vertices = 0;
  on_random_roadmaps([&](const Roadmap& roadmap, const Point& start, std::span<const Point> goals) {
    const std::vector<double> distances = distances_to_goals(roadmap, start, goals);
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const PlanResult raw = plan(roadmap, start, goals[i], {.shorten = false});
      if (!raw.ok() || raw.answered_by != Planner::kGraph) continue;
      EXPECT_NEAR(distances[i], raw.length, 1e-9);
      ++compared;
    }
    // From vertex to vertex no way leads to the graph or away from it: Dijkstra alone.
    const SparseGraph& graph = roadmap.graph;
    std::vector<Point> vertices;
    for (const Vertex& v : graph.vertices) vertices.push_back(v.position);
    const std::map<VertexId, double> exact = testing::dijkstra_graph(graph, VertexId{0}, 0.1);
    const std::vector<double> found = distances_to_goals(roadmap, vertices[0], vertices);
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const auto known = exact.find(VertexId{v});
      EXPECT_EQ(known != exact.end(), std::isfinite(found[v]));
      if (known == exact.end()) continue;
      EXPECT_NEAR(found[v], known->second, 1e-9);
      ++over_vertices;
    }
  });
  EXPECT_GT(compared, 100);
  EXPECT_GT(over_vertices, 100);
}

TEST(ManyGoals, APlaceOnTheWayThatIsTooNearIsBlamedAndNotTheStart) {
  OccupancyBuilder builder(0.1);
  builder.fill({{0, 0, 0}, {59, 59, 29}}, VoxelState::kFree);
  const Roadmap roadmap =
      build_roadmap(std::move(builder).finish(), {.min_clearance = 0.3}).roadmap;
  const PlanConfig config{.escape = true};
  const Point near_wall(0.15, 3.0, 1.5), middle(5.0, 5.0, 1.5);
  ASSERT_TRUE(plan(roadmap, near_wall, middle, config).ok());
  const std::vector<Point> places = {near_wall, Point(5.0, 0.1, 1.5), middle};
  const ViaPlan via = plan_via(roadmap, places, config);
  EXPECT_EQ(via.plan.status, PlanStatus::kGoalInCollision);
  EXPECT_EQ(via.leg, 0u);
  const std::vector<Point> twice = {near_wall, middle, middle, near_wall};
  const PlanResult whole = plan_via(roadmap, twice, config).plan;
  ASSERT_TRUE(whole.ok());
  EXPECT_EQ(std::adjacent_find(whole.waypoints.begin(), whole.waypoints.end()),
            whole.waypoints.end());
}

TEST(ManyGoals, RefuseBadInput) {
  const std::optional<Roadmap> roadmap = roadmap_with_room(1);
  ASSERT_TRUE(roadmap);
  const std::vector<Point> goals{Point(1, 1, std::nan(""))};
  EXPECT_THROW(distances_to_goals(*roadmap, Point(1, 1, 1), goals), InputError);
  EXPECT_THROW(plan_to_many(*roadmap, Point(1, 1, 1), goals, {.radius = -1.0}), InputError);
  EXPECT_THROW(plan_to_nearest(*roadmap, Point(1, 1, 1), {}), InputError);
  const std::vector<Point> place{Point(1, 1, 1)};
  EXPECT_THROW(distances_to_goals(*roadmap, Point(1, 1, 1), place, 0.5 * roadmap->min_clearance),
               InputError);
}

}  // namespace
}  // namespace ridgeway
