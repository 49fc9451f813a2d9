// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Every stage of the pipeline, and queries, on the map that comes with the project. Times are per
// stage on all threads; `voxels` counts what a stage walks over. Compare ratios within one run.
#include <benchmark/benchmark.h>

#include <random>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/io/load_map.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "ridgeway/skeleton/kernel.hpp"
#include "ridgeway/skeleton/thinning.hpp"

namespace ridgeway {
namespace {

constexpr double kRadius = 0.3;

/// The results of all stages, computed once: each benchmark repeats one of them.
struct Pipeline {
  OccupancyMap map = load_map(RIDGEWAY_DATA_DIR "/fr_079.bt", {});
  EsdfMap esdf = compute_esdf(map, {});
  VoxelMask traversable = traversable_voxels(esdf, kRadius);
  VoxelMask gvd = compute_gvd(esdf, traversable);
  VoxelMask edges = extract_edges(esdf, gvd);
  Basins basins = find_basins(esdf, traversable, kRadius);
  VoxelMask kernel = compute_kernel(esdf, traversable, basins);
  Roadmap roadmap = build_roadmap(map, {.min_clearance = kRadius}).roadmap;
};

const Pipeline& pipeline() {
  static const Pipeline all;
  return all;
}

void count_voxels_of(benchmark::State& state, std::size_t voxels) {
  state.counters["voxels"] =
      benchmark::Counter(static_cast<double>(voxels) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}

void load(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(load_map(RIDGEWAY_DATA_DIR "/fr_079.bt", {}));
  count_voxels_of(state, pipeline().esdf.layout.voxel_count());
}

void copy_of_the_field(benchmark::State& state) {  // what memory allows: the baseline
  for (auto _ : state) {
    VoxelField<std::uint32_t> copy = pipeline().esdf.squared;
    benchmark::DoNotOptimize(copy);
  }
  count_voxels_of(state, pipeline().esdf.layout.voxel_count());
}

void esdf(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    OccupancyMap map = pipeline().map;
    state.ResumeTiming();
    benchmark::DoNotOptimize(compute_esdf(std::move(map), {}));
  }
  count_voxels_of(state, pipeline().esdf.layout.voxel_count());
}

void gvd(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(compute_gvd(p.esdf, p.traversable));
  count_voxels_of(state, p.traversable.count());
}

void edges(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(extract_edges(pipeline().esdf, pipeline().gvd));
  count_voxels_of(state, pipeline().gvd.count());
}

void thinning(benchmark::State& state) {
  for (auto _ : state) {
    VoxelMask voxels = pipeline().edges;
    thin(pipeline().esdf.layout, voxels);
    benchmark::DoNotOptimize(voxels);
  }
  count_voxels_of(state, pipeline().edges.count());
}

void basins(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(find_basins(p.esdf, p.traversable, kRadius));
  count_voxels_of(state, p.traversable.count());
}

void kernel(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(compute_kernel(p.esdf, p.traversable, p.basins));
  count_voxels_of(state, p.traversable.count());
}

void graph(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        build_graph(roadmap.esdf, roadmap.diagram.voxels, {.min_clearance = kRadius}));
}

/// Pairs of places that a path connects.
std::vector<std::pair<Point, Point>> draw_queries(std::size_t count) {
  const EsdfMap& esdf = pipeline().esdf;
  const std::vector<VoxelId> places = pipeline().traversable.members();
  std::mt19937 random(1);
  std::vector<std::pair<Point, Point>> queries;
  while (queries.size() < count) {
    const auto place = [&] {
      return centre_of(esdf.layout.index_of(places[random() % places.size()]), esdf.voxel_size);
    };
    const Point start = place(), goal = place();
    if (plan(pipeline().roadmap, start, goal, {.shorten = false}).ok())
      queries.emplace_back(start, goal);
  }
  return queries;
}

const std::vector<std::pair<Point, Point>>& solvable_queries() {
  static const auto queries = draw_queries(500);
  return queries;
}

void query(benchmark::State& state, const PlanConfig& config) {
  const auto& queries = solvable_queries();
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [start, goal] = queries[i++ % queries.size()];
    benchmark::DoNotOptimize(plan(pipeline().roadmap, start, goal, config));
  }
}

/// Built before the first benchmark starts its clock.
[[maybe_unused]] const bool kBuilt = !solvable_queries().empty();

BENCHMARK(copy_of_the_field)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(load)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(esdf)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gvd)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(edges)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(thinning)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(basins)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(kernel)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(graph)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(query, graph_raw, PlanConfig{.shorten = false})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, graph_shortened, PlanConfig{})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, diagram, PlanConfig{.planner = Planner::kDiagram, .shorten = false})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(query, esdf, PlanConfig{.planner = Planner::kEsdf, .shorten = false})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ridgeway
