// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// The parts of a query, one after the other on one thread, and whole queries. Each iteration is one
// of them, on random places of the map that comes with the project.
#include "bench_data.hpp"
#include "paths/shorten.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"
#include "roadmap/attach_way.hpp"
#include "roadmap/graph_search.hpp"
#include "roadmap/tangent_search.hpp"

namespace ridgeway {
namespace {

/// Segments of a length in random directions, in the order of the places they begin at; `is_free`:
/// all of them free, or all blocked.
std::vector<Query> segments(double length, bool is_free) {
  const FreeSpace space(pipeline().esdf);
  const std::vector<Point> places = random_places(20000);
  std::vector<Query> result;
  for (std::size_t i = 0; i + 1 < places.size(); i += 2) {
    const Point& a = places[i];
    const Point b = a + length * (places[i + 1] - a).normalized();
    if (space.is_free(a, b, kRadius) == is_free) result.emplace_back(a, b);
  }
  return result;
}

/// Runs work(item) for one item after the other, around and around.
template <typename Items, typename Work>
void one_by_one(benchmark::State& state, const char* what, const Items& items, const Work& work) {
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(work(items[i++ % items.size()]));
  report_rate(state, what, 1);
}

void segment_check(benchmark::State& state, double length, bool is_free) {  // sphere tracing
  const FreeSpace space(pipeline().esdf);
  one_by_one(state, "segments", segments(length, is_free), [&](const Query& segment) {
    return space.is_free(segment.first, segment.second, kRadius);
  });
}

void attach(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  const EsdfMap& esdf = roadmap.esdf;
  one_by_one(state, "ways", random_places(10000), [&](const Point& place) {
    const VoxelId voxel = esdf.layout.find(voxel_at(place, esdf.voxel_size));
    return detail::follow_attach(roadmap, voxel, kRadius);
  });
}

void graph_search(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  const EsdfMap& esdf = roadmap.esdf;
  const auto vertex = [&](const Point& place) {
    const VoxelId voxel = esdf.layout.find(voxel_at(place, esdf.voxel_size));
    return detail::follow_attach(roadmap, voxel, kRadius).vertex;
  };
  std::vector<std::pair<VertexId, VertexId>> ends;
  for (const auto& [start, goal] : solvable_queries())
    if (vertex(start) != kNoVertex && vertex(goal) != kNoVertex)
      ends.emplace_back(vertex(start), vertex(goal));
  one_by_one(state, "searches", ends, [&](const auto& pair) {
    return detail::search_graph(roadmap.graph, roadmap.landmarks, pair.first, pair.second, kRadius);
  });
}

void tangent_search(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  const auto seen = [&](const Point& place) {
    return roadmap.tangents.seen_from(esdf.layout.find(voxel_at(place, esdf.voxel_size)));
  };
  one_by_one(state, "searches", solvable_queries(), [&](const Query& ends) {
    return detail::search_tangents(
        roadmap.tangents.graph, roadmap.tangents.hubs, space,
        {ends.first, ends.second, kRadius, seen(ends.first), seen(ends.second)});
  });
}

void shortening(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  const FreeSpace space(roadmap.esdf);
  std::vector<std::vector<Point>> paths;
  for (const auto& [start, goal] : solvable_queries())
    paths.push_back(plan(roadmap, start, goal, {.shorten = false}).waypoints);
  const detail::Deadline never(1e9);
  one_by_one(state, "paths", paths, [&](const std::vector<Point>& path) {
    return detail::shorten(space, path, kRadius, never);
  });
}

void query(benchmark::State& state, const PlanConfig& config) {
  const Roadmap& roadmap = pipeline().roadmap;
  one_by_one(state, "queries", solvable_queries(),
             [&](const Query& ends) { return plan(roadmap, ends.first, ends.second, config); });
}

BENCHMARK_CAPTURE(segment_check, free_half_metre, 0.5, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(segment_check, free_three_metres, 3.0, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(segment_check, blocked_three_metres, 3.0, false)->Unit(benchmark::kMicrosecond);
BENCHMARK(attach)->Unit(benchmark::kMicrosecond);
BENCHMARK(graph_search)->Unit(benchmark::kMicrosecond);
BENCHMARK(tangent_search)->Unit(benchmark::kMicrosecond);
BENCHMARK(shortening)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, graph_raw, PlanConfig{.shorten = false})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, graph_quick, PlanConfig{.quick = true})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, graph_shortened, PlanConfig{})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, diagram, PlanConfig{.planner = Planner::kDiagram, .shorten = false})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, esdf, PlanConfig{.planner = Planner::kEsdf, .shorten = false})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ridgeway
