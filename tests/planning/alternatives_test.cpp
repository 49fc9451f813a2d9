// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/pillars.hpp"
#include "support/random_maps.hpp"
#include "support/shapes.hpp"

namespace ridgeway {
namespace {

using Axes = std::vector<Eigen::Vector2d>;
/// The homotopy class of a path in a hall of pillars, among those with the same ends: which of the
/// rays that go out from the pillars towards +y it crosses, freely reduced; i + 1 where it crosses
/// that of pillar i towards +x, else -(i + 1).
using Word = std::vector<int>;

using testing::kPillarClearance;
const Point kStart(0.5, 2.9, 0.4), kGoal(7.4, 3.1, 0.4);

Roadmap build_pillars(const OccupancyMap& map) {
  return build_roadmap(map, {.min_clearance = kPillarClearance}).roadmap;
}

void append_crossings(const Point& a, const Point& b, const Axes& axes, Word& word) {
  std::vector<std::pair<double, int>> crossings;  // share of the segment, letter
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if ((a.x() < axes[i].x()) == (b.x() < axes[i].x())) continue;
    const double t = (axes[i].x() - a.x()) / (b.x() - a.x());
    const int letter = static_cast<int>(i) + 1;
    if (a.y() + t * (b.y() - a.y()) > axes[i].y())
      crossings.emplace_back(t, a.x() < b.x() ? letter : -letter);
  }
  std::sort(crossings.begin(), crossings.end());
  for (const auto& [t, letter] : crossings) {
    if (!word.empty() && word.back() == -letter)
      word.pop_back();
    else
      word.push_back(letter);
  }
}

Word word_of(const std::vector<Point>& path, const Axes& axes) {
  Word word;
  for (std::size_t i = 1; i < path.size(); ++i) append_crossings(path[i - 1], path[i], axes, word);
  return word;
}

/// Whether a triangle has none of the axes in it.
bool is_swept(const Point& a, const Point& b, const Point& c, const Axes& axes) {
  const Word word = word_of({a, b, c, a}, axes);
  return word.empty();
}

/// To which vertices start and goal are joined: to all that they see, or without those that they
/// see past a nearer one.
enum class Joined { kAll, kNearest };

/// The classes of all paths that pass no vertex twice, one by one.
class SimplePaths {
 public:
  SimplePaths(const Roadmap& roadmap, const Axes& axes)
      : graph_(roadmap.graph), space_(roadmap.esdf), axes_(axes) {}

  std::set<Word> between(const Point& start, const Point& goal, Joined which) {
    words_.clear();
    goal_ = goal;
    passed_.assign(graph_.vertices.size(), false);
    last_ = joined_to(goal, which);
    if (space_.is_free(start, goal, kPillarClearance)) words_.insert(word_of({start, goal}, axes_));
    const std::vector<bool> first = joined_to(start, which);
    for (std::uint32_t v = 0; v < first.size(); ++v)
      if (first[v]) visit(VertexId{v}, start, {});
    return words_;
  }

 private:
  std::vector<bool> joined_to(const Point& end, Joined which) const {
    const auto at = [&](VertexId v) { return graph_.vertices[number(v)].position; };
    std::vector<bool> joined(graph_.vertices.size());
    for (std::uint32_t v = 0; v < joined.size(); ++v) {
      joined[v] = space_.is_free(end, at(VertexId{v}), kPillarClearance);
      if (which == Joined::kAll) continue;
      for (const Link& link : graph_.links_of(VertexId{v}))
        if ((at(link.vertex) - end).norm() < (at(VertexId{v}) - end).norm() &&
            space_.is_free(end, at(link.vertex), kPillarClearance) &&
            is_swept(end, at(link.vertex), at(VertexId{v}), axes_))
          joined[v] = false;
    }
    return joined;
  }

  void visit(VertexId v, const Point& from, Word word) {
    const Point& here = graph_.vertices[number(v)].position;
    append_crossings(from, here, axes_, word);
    passed_[number(v)] = true;
    if (last_[number(v)]) {
      Word whole = word;
      append_crossings(here, goal_, axes_, whole);
      words_.insert(whole);
    }
    for (const Link& link : graph_.links_of(v))
      if (!passed_[number(link.vertex)]) visit(link.vertex, here, word);
    passed_[number(v)] = false;
  }

  const SparseGraph& graph_;
  const FreeSpace space_;
  const Axes& axes_;
  Point goal_ = Point::Zero();
  std::vector<bool> passed_, last_;
  std::set<Word> words_;
};

/// Whether the way from one sheet of the hall to another may lie over a third one. A shortest path
/// crosses no ray twice where rays end at nothing; but one that goes around a pillar crosses the
/// rays of others that go through it, to and fro.
bool may_lead_over(const Word& sheet, const Word& word, std::size_t most_off) {
  const auto parted = std::mismatch(sheet.begin(), sheet.end(), word.begin(), word.end());
  return static_cast<std::size_t>(sheet.end() - parted.first) <= most_off;
}

/// The shortest path of the same class over places of a path: a grid has eight directions alone,
/// and many shortest paths, most of them slack.
std::vector<Point> pulled_straight(const FreeSpace& space, const std::vector<Point>& path,
                                   const Axes& axes) {
  std::vector<double> cost(path.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(path.size(), 0);
  if (!path.empty()) cost[0] = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    std::vector<Point> loop{path[i]};
    for (std::size_t j = i + 1; j < path.size(); ++j) {
      loop.push_back(path[j]);
      const double there = cost[i] + (path[j] - path[i]).norm();
      if (there >= cost[j] || !space.is_free(path[i], path[j], kPillarClearance)) continue;
      loop.push_back(path[i]);
      if (word_of(loop, axes).empty()) {
        cost[j] = there;
        from[j] = i;
      }
      loop.pop_back();
    }
  }
  std::vector<Point> straight;  // from the other end
  for (std::size_t i = path.size() - 1; !path.empty() && i > 0; i = from[i])
    straight.push_back(path[i]);
  if (!path.empty()) straight.push_back(path.front());
  return straight;
}

/// The shortest path of a class over a grid of points, a fifth of a metre apart, at the height of
/// start and goal. Sheets of the hall are told apart by their words.
std::vector<Point> shortest_of_class(const EsdfMap& esdf, const Axes& axes, const Word& word) {
  constexpr int kColumns = 40, kRows = 30;
  constexpr double kStep = 0.2;
  const FreeSpace space(esdf);
  const auto at = [&](int cell) {
    const int column = cell % kColumns, row = cell / kColumns;
    return Point(kStep * (column + 0.5), kStep * (row + 0.5), kStart.z());
  };
  const auto nearest = [&](const Point& p) {
    return static_cast<int>(p.x() / kStep) + kColumns * static_cast<int>(p.y() / kStep);
  };
  std::map<std::pair<int, int>, bool> looked_at;
  const auto is_free = [&](int a, int b) {
    const auto [entry, is_new] = looked_at.try_emplace(std::minmax(a, b));
    if (is_new) entry->second = space.is_free(at(a), at(b), kPillarClearance);
    return entry->second;
  };
  using State = std::pair<Word, int>;  // sheet, cell
  std::map<State, double> cost{{{{}, nearest(kStart)}, 0.0}};
  std::map<State, State> from;
  std::set<std::pair<double, State>> open{{0.0, {{}, nearest(kStart)}}};
  const State goal{word, nearest(kGoal)};
  while (!open.empty() && open.begin()->second != goal) {
    const auto [length, here] = *open.begin();
    open.erase(open.begin());
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = here.second % kColumns + dx, y = here.second / kColumns + dy;
        if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= kColumns || y >= kRows) continue;
        const Point a = at(here.second), b = at(x + kColumns * y);
        State next{here.first, x + kColumns * y};
        append_crossings(a, b, axes, next.first);
        if (!may_lead_over(next.first, word, axes.size() - 1)) continue;
        const double there = length + (b - a).norm();
        const auto known = cost.find(next);
        if ((known != cost.end() && known->second <= there) || !is_free(here.second, next.second))
          continue;
        if (known != cost.end()) open.erase({known->second, next});
        cost[next] = there;
        from[next] = here;
        open.insert({there, std::move(next)});
      }
  }
  std::vector<Point> path;
  for (State s = goal; from.contains(s); s = from.at(s)) path.push_back(at(s.second));
  return pulled_straight(space, path, axes);
}

/// Whether a path comes back to within a radius and a half of where it was.
bool comes_back(const std::vector<Point>& corners) {
  std::vector<Point> path{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (int k = 1; k <= 20; ++k)
      path.emplace_back(corners[i - 1] + (corners[i] - corners[i - 1]) * (k / 20.0));
  for (std::size_t i = 0; i < path.size(); ++i) {
    double between = 0.0;
    for (std::size_t j = i + 1; j < path.size(); ++j) {
      between += (path[j] - path[j - 1]).norm();
      if (between > 4.0 * kPillarClearance && (path[j] - path[i]).norm() < 1.5 * kPillarClearance)
        return true;
    }
  }
  return false;
}

/// How many classes there were, and how many of them have no shortest path but one that comes back.
struct Classes {
  std::size_t found = 0, left_out = 0;
};

/// Counts those of a hall of pillars, and expects one alternative for each of the others.
void expect_one_for_each_class(const Roadmap& roadmap, const Axes& axes, Classes& classes) {
  const Alternatives found = plan_alternatives(roadmap, kStart, kGoal, 100);
  ASSERT_TRUE(found.ok());
  EXPECT_TRUE(found.complete);
  std::set<Word> words;
  for (const PlanResult& route : found.routes) words.insert(word_of(route.waypoints, axes));
  EXPECT_EQ(words.size(), found.routes.size());  // no two are homotopic
  classes.found += words.size();
  SimplePaths simple(roadmap, axes);
  for (const Word& word : simple.between(kStart, kGoal, Joined::kNearest)) {
    if (words.contains(word)) continue;
    const std::vector<Point> shortest = shortest_of_class(roadmap.esdf, axes, word);
    ASSERT_FALSE(shortest.empty());
    EXPECT_TRUE(comes_back(shortest));
    ++classes.left_out;
  }
  const std::set<Word> all = simple.between(kStart, kGoal, Joined::kAll);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), words.begin(), words.end()));
  if (axes.size() == 1) {
    EXPECT_EQ(words.size(), 2u);
  }
}

TEST(Alternatives, AreOneForEachClassOfSimpleRoutesAroundPillars) {
  Classes classes;
  for (const auto first : {testing::DrawnFirst::kX, testing::DrawnFirst::kY})
    for (std::size_t count = 1; count <= 3; ++count)
      for (unsigned seed = 4; seed < 12; ++seed) {
        SCOPED_TRACE(std::to_string(count) + " pillars, seed " + std::to_string(seed) +
                     (first == testing::DrawnFirst::kX ? ", x" : ", y") + " drawn first");
        Axes axes;
        const OccupancyMap hall = testing::pillars(seed, axes, count, first);
        expect_one_for_each_class(build_pillars(hall), axes, classes);
      }
  EXPECT_GT(classes.found, 16u * (2 + 3 + 6));
  EXPECT_GT(classes.left_out, 0u);
  EXPECT_LT(classes.left_out, classes.found / 10);
}

TEST(Alternatives, AreVerifiedShortestFirstAndNoLongerThanThePlan) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Axes axes;
    const auto policy = seed % 2 == 0 ? UnknownPolicy::kObstacle : UnknownPolicy::kIgnore;
    const Roadmap roadmap = build_roadmap(testing::pillars(seed, axes),
                                          {.min_clearance = kPillarClearance, .unknown = policy})
                                .roadmap;
    const FreeSpace space(roadmap.esdf);
    for (const double radius : {kPillarClearance, 1.2 * kPillarClearance}) {
      const PlanConfig config{.radius = radius};
      const Alternatives found = plan_alternatives(roadmap, kStart, kGoal, 4, config);
      ASSERT_TRUE(found.ok());
      ASSERT_EQ(found.routes.size(), 4u);
      EXPECT_LE(found.routes[0].length,
                plan(roadmap, kStart, kGoal, config).length * (1.0 + 1e-12));
      std::set<Word> words;
      for (std::size_t i = 0; i < found.routes.size(); ++i) {
        const PlanResult& route = found.routes[i];
        EXPECT_EQ(route.waypoints.front(), kStart);
        EXPECT_EQ(route.waypoints.back(), kGoal);
        EXPECT_EQ(route.unknown, policy);
        EXPECT_GE(space.clearance(route.waypoints), radius * (1.0 - 1e-9));
        if (i > 0) {
          EXPECT_GE(route.length, found.routes[i - 1].length);
        }
        words.insert(word_of(route.waypoints, axes));
      }
      EXPECT_EQ(words.size(), found.routes.size());
      // Fewer are the first ones of these, but for what more searching shortens.
      const Alternatives two = plan_alternatives(roadmap, kStart, kGoal, 2, config);
      ASSERT_EQ(two.routes.size(), 2u);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(two.routes[i].length, found.routes[i].length, 0.01 * found.routes[i].length);
    }
  }
}

TEST(Alternatives, GoPastAFloatingBoxOnEverySide) {
  const testing::Shape shape = testing::test_shape("floating_box");
  const Roadmap roadmap =
      build_roadmap(shape.map(), {.min_clearance = shape.min_clearance}).roadmap;
  const Point start(0.6, 2, 1.5), goal(3.4, 2, 1.5);  // the box stands between them
  const Alternatives found = plan_alternatives(roadmap, start, goal, 10);
  ASSERT_TRUE(found.ok());
  std::set<std::string> sides;
  for (const PlanResult& route : found.routes)
    for (std::size_t i = 1; i < route.waypoints.size(); ++i) {
      const Point a = route.waypoints[i - 1], b = route.waypoints[i];
      if ((a.x() < 2) == (b.x() < 2)) continue;
      const Point p = a + (b - a) * ((2 - a.x()) / (b.x() - a.x()));
      if (p.z() < 1.2) sides.insert("below");
      if (p.z() > 1.9) sides.insert("above");
      if (p.y() < 1.5) sides.insert("right");
      if (p.y() > 2.5) sides.insert("left");
    }
  EXPECT_EQ(sides.size(), 4u);
}

/// Largest distance of places of one path from another.
double farthest_from(const std::vector<Point>& path, const std::vector<Point>& other) {
  double farthest = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    for (int k = 0; k <= 60; ++k) {
      const Point p = path[i - 1] + (path[i] - path[i - 1]) * (k / 60.0);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 1; j < other.size(); ++j) {
        const Point along = other[j] - other[j - 1];
        const double squared = along.squaredNorm();
        const double t =
            squared > 0.0 ? std::clamp((p - other[j - 1]).dot(along) / squared, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, (other[j - 1] + t * along - p).norm());
      }
      farthest = std::max(farthest, nearest);
    }
  return farthest;
}

TEST(Alternatives, AreApartSomewhereByTheRadiusAtLeast) {
  int pairs = 0;
  for (unsigned seed = 0; seed < 90; ++seed) {
    SCOPED_TRACE(seed);
    Roadmap roadmap;
    try {
      roadmap =
          build_roadmap(testing::random_map(seed, 24), {.min_clearance = 0.1, .tangent_pairs = 50})
              .roadmap;
    } catch (const InputError&) {
      continue;
    }
    const std::vector<Vertex>& vertices = roadmap.graph.vertices;
    if (vertices.size() < 2) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const Alternatives found =
          plan_alternatives(roadmap, vertices[i * 7 % vertices.size()].position,
                            vertices[(i * 5 + 3) % vertices.size()].position, 5);
      for (std::size_t a = 0; a < found.routes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          ++pairs;
          const auto& one = found.routes[a].waypoints;
          const auto& two = found.routes[b].waypoints;
          EXPECT_GE(std::max(farthest_from(one, two), farthest_from(two, one)), 0.1 * 0.9);
        }
    }
  }
  EXPECT_GT(pairs, 50);
}

TEST(Alternatives, SayWhyThereIsNoneAndRefuseOtherPlanners) {
  Axes axes;
  const Roadmap roadmap = build_pillars(testing::pillars(0, axes));
  const Alternatives none = plan_alternatives(roadmap, kStart, Point(7.4, 3.1, 5.0), 3);
  EXPECT_EQ(none.status, PlanStatus::kGoalOutsideMap);
  EXPECT_TRUE(none.routes.empty());
  EXPECT_THROW(plan_alternatives(roadmap, kStart, kGoal, 0), InputError);
  EXPECT_THROW(plan_alternatives(roadmap, kStart, kGoal, 2, {.planner = Planner::kEsdf}),
               InputError);
  EXPECT_THROW(plan_alternatives(roadmap, kStart, kGoal, 2, {.shorten = false}), InputError);
  EXPECT_THROW(plan_alternatives(roadmap, kStart, kGoal, 2, {.quick = true}), InputError);
  EXPECT_THROW(plan_alternatives(roadmap, kStart, kGoal, 2, {.within = 1.01}), InputError);
}

}  // namespace
}  // namespace ridgeway
