// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "common/number_text.hpp"
#include "common/rounding.hpp"
#include "esdf/cylinder_room.hpp"
#include "mapping/memory_limit.hpp"
#include "paths/planning_constants.hpp"
#include "query.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway {
namespace {

/// Half of the radii are one of these times the smallest, half of them between two.
constexpr auto& kRadiusFactors = detail::kRadiusLevels;
constexpr std::size_t kBatch = 64;  // queries between two reports of progress

struct Query {
  Point start, goal;  // local
  double radius;
};

struct Outcome {
  PlanResult roadmap, raw, esdf;
  bool is_complete = false;  ///< all three are there
};

/// Places anywhere in traversable voxels that fit the radius; queries whose radius no voxel fits,
/// or the distance field does not reach, keep the smallest.
std::vector<Query> draw_queries(const Roadmap& roadmap, const CheckConfig& config) {
  const EsdfMap& esdf = roadmap.esdf;
  std::array<std::vector<VoxelId>, kRadiusFactors.size()> places;
  const bool is_sphere = config.robot_height == 0.0;
  const double largest = largest_radius(esdf);
  const FlightLimits limits = detail::limits_of(esdf, config.limits);
  detail::CylinderRoom room(esdf, roadmap.min_clearance / esdf.voxel_size,
                            0.5 * config.robot_height / esdf.voxel_size);
  const FreeSpace space(FreeSpace(esdf, limits, roadmap.min_clearance, config.robot_height), room);
  std::vector<SquaredHalves> least;  // of the factors that count
  for (const double factor : kRadiusFactors) {
    const double radius = factor * roadmap.min_clearance;
    if (!least.empty() && !(is_sphere && radius <= largest)) break;
    least.push_back(least_clearance(space.inner_radius(radius), esdf.voxel_size));
  }
  for (std::uint32_t order = 0; order < esdf.layout.voxel_count(); ++order) {
    const VoxelId id = esdf.layout.voxel_at_order(order);
    if (!esdf.is_open(id) || !space.is_within_limits(id)) continue;
    for (std::size_t k = 0; k < least.size(); ++k)
      if (space.move_is_free(id, id, kCentre, least[k])) places[k].push_back(id);
  }
  if (places[0].empty() && config.queries > 0)
    throw InputError("check", "finds no place within the limits where the robot fits",
                     "give wider limits or a lower robot, or ask for no queries");
  std::mt19937_64 random(config.seed);
  std::vector<Query> queries(config.queries);
  for (Query& query : queries) {
    std::size_t k = random() % places.size();
    if (places[k].empty()) k = 0;
    query.radius = kRadiusFactors[k] * roadmap.min_clearance;
    if (k + 1 < places.size() && !places[k + 1].empty() && random() % 2 == 0)
      query.radius += static_cast<double>(random() % 1000) / 1000.0 *
                      (kRadiusFactors[k + 1] - kRadiusFactors[k]) * roadmap.min_clearance;
    const SquaredHalves own = least_clearance(space.inner_radius(query.radius), esdf.voxel_size);
    for (Point* point : {&query.start, &query.goal}) {
      VoxelId place = places[k][random() % places[k].size()];
      if (esdf.squared[place] < own) place = places[k + 1][random() % places[k + 1].size()];
      const VoxelIndex v = esdf.layout.index_of(place);
      // Off the centre, where the robot fits there, and not out of the limits.
      const auto off = [&] { return 0.2 * (static_cast<double>(random() % 1001) / 1000.0 - 0.5); };
      const Point centre = centre_of(v, esdf.voxel_size);
      if (!is_sphere) {
        *point = centre;
        continue;
      }
      Point shift;  // one by one, as compilers differ in the order of arguments
      for (const int axis : {2, 1, 0}) shift[axis] = off();
      *point = space.nearest_within(centre + shift * esdf.voxel_size);
      if (!space.is_free(*point, query.radius)) *point = centre;
    }
  }
  return queries;
}

/// All segments once more, and the stated clearance, by the predicate.
bool holds_clearance(const FreeSpace& space, const PlanResult& result, double radius) {
  for (std::size_t i = 1; i < result.waypoints.size(); ++i)
    if (!space.is_free(result.waypoints[i - 1], result.waypoints[i], radius)) return false;
  return space.is_within_limits(result.waypoints) &&
         detail::is_as_wide(result.clearance, space.inner_radius(radius));
}

/// Whether an answer differs from that of A* where it may not. Within limits there are ways that
/// moves between voxels do not have, as where a band is a few voxels high: finding one is no fault.
bool disagrees(const PlanResult& answer, const PlanResult& esdf, bool is_limited) {
  if (is_limited && esdf.status == PlanStatus::kNoRoute && answer.ok()) return false;
  return answer.status != esdf.status;
}

void summarise(const Roadmap& roadmap, const CheckConfig& config, const std::vector<Query>& queries,
               std::vector<Outcome>& outcomes, CheckReport& report) {
  const FlightLimits limits = detail::limits_of(roadmap.esdf, config.limits);
  const FreeSpace space(roadmap.esdf, limits, roadmap.min_clearance, config.robot_height);
  std::vector<double> ratios, microseconds, raw, esdf;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    Outcome& o = outcomes[i];
    if (!o.is_complete) continue;
    ++report.queries;
    report.graph_ok += o.roadmap.ok();
    report.esdf_ok += o.esdf.ok();
    report.disagreements +=
        disagrees(o.roadmap, o.esdf, limits.any()) || disagrees(o.raw, o.esdf, limits.any());
    report.fallbacks += o.roadmap.ok() && o.roadmap.answered_by != Planner::kGraph;
    if (!o.roadmap.ok()) continue;
    microseconds.push_back(o.roadmap.seconds.total * 1e6);
    raw.push_back(o.raw.seconds.total * 1e6);
    esdf.push_back(o.esdf.seconds.total * 1e3);
    for (const PlanResult* path : {&o.roadmap, &o.raw, &o.esdf})
      report.paths_below_clearance +=
          path->ok() && !holds_clearance(space, *path, queries[i].radius);
    if (o.esdf.ok() && o.roadmap.length > 0.0)
      ratios.push_back(o.roadmap.length / std::min(o.roadmap.length, o.esdf.length));
    for (Point& p : o.roadmap.waypoints) p = to_world(roadmap.esdf, p);
    report.paths.push_back({queries[i].radius, std::move(o.roadmap.waypoints)});
  }
  report.length_ratio = spread_of(std::move(ratios));
  report.microseconds = spread_of(std::move(microseconds));
  report.raw_microseconds = spread_of(std::move(raw));
  report.esdf_milliseconds = spread_of(std::move(esdf));
}

void report_progress(const Progress& progress, std::size_t done, std::size_t of) {
  if (progress && !progress("check", static_cast<double>(done) / static_cast<double>(of)))
    throw Cancelled();
}

void check_edges(const Roadmap& roadmap, const Progress& progress, CheckReport& report) {
  const FreeSpace space(roadmap.esdf);
  const SparseGraph& graph = roadmap.graph;
  const double least = detail::least_fit(roadmap.min_clearance);
  for (const Edge& edge : graph.edges) {
    if (report.edges % kBatch == 0) report_progress(progress, 0, 1);
    const Point& a = graph.vertices[number(edge.from)].position;
    const Point& b = graph.vertices[number(edge.to)].position;
    report.edges_below_clearance += edge.clearance < least || space.clearance(a, b) < least;
    ++report.edges;
  }
  report.components = connected_components(graph).count;
}

PlanConfig answers_of(const CheckConfig& config) {
  return {.quick = config.quick,
          .within = config.within,
          .limits = config.limits,
          .robot_height = config.robot_height};
}

/// Answers the queries batch by batch, each into the outcome of its number. Where it is cancelled
/// those that were answered are complete.
void ask_all(const Roadmap& roadmap, const CheckConfig& config, const std::vector<Query>& queries,
             const Progress& progress, std::vector<Outcome>& outcomes) {
  const PlanConfig own = answers_of(config);
  PlanConfig esdf = own;
  esdf.quick = false;
  esdf.within = 0.0;
  PlanConfig raw = esdf;
  esdf.planner = Planner::kEsdf;
  raw.shorten = false;
  const auto ask = [&](const Query& q, PlanConfig plan) {
    plan.radius = q.radius;
    return detail::plan_locally(roadmap, q.start, q.goal, plan);
  };
  outcomes.resize(queries.size());
  for (std::size_t first = 0; first < queries.size(); first += kBatch) {
    report_progress(progress, first, queries.size());
    const std::size_t batch = std::min(kBatch, queries.size() - first);
    parallel_for_each_index(batch, [&](std::size_t k) {
      outcomes[first + k].roadmap = ask(queries[first + k], own);
      outcomes[first + k].raw = ask(queries[first + k], raw);
    });
    // Apart, so that its sweep through the map does not slow down the queries that are timed.
    parallel_for_each_index(batch, [&](std::size_t k) {
      outcomes[first + k].esdf = ask(queries[first + k], esdf);
      outcomes[first + k].is_complete = true;
    });
  }
}

/// A roadmap says nothing about robots in which no ball of its smallest radius is.
void require_room_for_balls(const Roadmap& roadmap, const CheckConfig& config) {
  const double inner = 0.5 * config.robot_height;
  if (inner == 0.0 || detail::is_as_wide(inner, roadmap.min_clearance)) return;
  throw InputError("robot_height " + number_text(config.robot_height),
                   "holds no ball of " + number_text(roadmap.min_clearance) +
                       " m, the smallest radius of the roadmap",
                   "build the roadmap with a min_clearance of " + number_text(inner));
}

}  // namespace

void CheckConfig::validate() const { answers_of(*this).validate(); }

CheckReport check_roadmap(const Roadmap& roadmap, const CheckConfig& config,
                          const Progress& progress) {
  CheckReport report;
  check_roadmap(roadmap, config, progress, report);
  return report;
}

void check_roadmap(const Roadmap& roadmap, const CheckConfig& config, const Progress& progress,
                   CheckReport& report) {
  report = {};
  config.validate();
  constexpr double kBytesPerQuery = 1000.0;  // with what was answered
  require_memory(static_cast<double>(config.queries) * kBytesPerQuery, "queries",
                 "ask for fewer at a time");
  require_room_for_balls(roadmap, config);
  std::vector<Query> queries;
  std::vector<Outcome> outcomes;
  try {
    with_progress(progress, "check", [&](const Progress& go_on) {
      check_edges(roadmap, go_on, report);
      queries = draw_queries(roadmap, config);
      ask_all(roadmap, config, queries, go_on, outcomes);
    });
  } catch (const Cancelled&) {
    summarise(roadmap, config, queries, outcomes, report);
    throw;
  }
  summarise(roadmap, config, queries, outcomes, report);
}

}  // namespace ridgeway
