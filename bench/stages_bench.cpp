// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Every stage of the pipeline on the map that comes with the project, on all threads, beside a
// plain copy of the field of distances: the same number of voxels, and about what memory allows.
// `voxels` counts what a stage walks over. Compare ratios within one run.
#include "bench_data.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {
namespace {

void load(benchmark::State& state) {
  const std::size_t voxels = pipeline().esdf.layout.voxel_count();
  for (auto _ : state) benchmark::DoNotOptimize(load_map(RIDGEWAY_DATA_DIR "/fr_079.bt", {}));
  report_rate(state, "voxels", voxels);
}

void copy_of_the_field(benchmark::State& state) {
  const EsdfMap& esdf = pipeline().esdf;
  for (auto _ : state) {
    VoxelField<std::uint32_t> copy = esdf.squared;
    benchmark::DoNotOptimize(copy);
  }
  report_rate(state, "voxels", esdf.layout.voxel_count());
}

void distance_sweeps(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) {
    state.PauseTiming();
    OccupancyMap map = p.map;
    state.ResumeTiming();
    benchmark::DoNotOptimize(compute_esdf(std::move(map), {}));
  }
  report_rate(state, "voxels", p.esdf.layout.voxel_count());
}

void gvd_test(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(compute_gvd(p.esdf, p.traversable));
  report_rate(state, "voxels", p.traversable.count());
}

void edge_count(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(extract_edges(p.esdf, p.gvd));
  report_rate(state, "voxels", p.gvd.count());
}

void thinning(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) {
    VoxelMask voxels = p.edges;
    thin(p.esdf.layout, voxels);
    benchmark::DoNotOptimize(voxels);
  }
  report_rate(state, "voxels", p.edges.count());
}

void basins(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(find_basins(p.esdf, p.traversable, kRadius));
  report_rate(state, "voxels", p.traversable.count());
}

void kernel(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) benchmark::DoNotOptimize(compute_kernel(p.esdf, p.traversable, p.basins));
  report_rate(state, "voxels", p.traversable.count());
}

void graph_fitting(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        build_graph(roadmap.esdf, roadmap.diagram.voxels, {.min_clearance = kRadius}));
  report_rate(state, "voxels", roadmap.diagram.voxels.count());
}

void graph_simplifying(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  const SparseGraph fitted =
      build_graph(roadmap.esdf, roadmap.diagram.voxels, {.min_clearance = kRadius});
  for (auto _ : state) benchmark::DoNotOptimize(simplify_graph(roadmap.esdf, fitted));
  report_rate(state, "edges", fitted.edges.size());
}

void attach_field(benchmark::State& state) {
  const Pipeline& p = pipeline();
  for (auto _ : state) {
    state.PauseTiming();
    Basins own = p.basins;
    state.ResumeTiming();
    benchmark::DoNotOptimize(build_attach_field(p.roadmap.esdf, p.roadmap.diagram.voxels,
                                                p.roadmap.graph, std::move(own)));
  }
  report_rate(state, "voxels", p.roadmap.diagram.voxels.count());
}

void corner_learning(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  for (auto _ : state) benchmark::DoNotOptimize(build_tangent_graph(roadmap));
}

BENCHMARK(copy_of_the_field)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(load)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(distance_sweeps)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gvd_test)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(edge_count)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(thinning)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(basins)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(kernel)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(graph_fitting)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(graph_simplifying)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(attach_field)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(corner_learning)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace ridgeway
