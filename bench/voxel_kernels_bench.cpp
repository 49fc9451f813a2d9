// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// Decisions about single voxels and curves, on one thread, as the skeleton's stages take them.
#include "bench_data.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "roadmap/curve_following.hpp"
#include "roadmap/diagram_curves.hpp"
#include "roadmap/vertex_selection.hpp"
#include "skeleton/simple_point.hpp"

namespace ridgeway {
namespace {

/// The neighbourhoods of a set's voxels in the set.
std::vector<Cube27> cubes_of(const VoxelMask& mask) {
  const BlockLayout& layout = pipeline().esdf.layout;
  std::vector<Cube27> cubes;
  for (const VoxelId id : mask.members(layout)) cubes.push_back(cube_around(layout, mask, id));
  return cubes;
}

void copy_of_neighbourhoods(benchmark::State& state) {  // the baseline of the next two
  const std::vector<Cube27> cubes = cubes_of(pipeline().edges);
  for (auto _ : state) {
    std::vector<Cube27> copy = cubes;
    benchmark::DoNotOptimize(copy.data());
  }
  report_rate(state, "voxels", cubes.size());
}

void gathering_neighbourhoods(benchmark::State& state) {
  const Pipeline& p = pipeline();
  const std::vector<VoxelId> members = p.edges.members(p.esdf.layout);
  for (auto _ : state)
    for (const VoxelId id : members)
      benchmark::DoNotOptimize(cube_around(p.esdf.layout, p.edges, id));
  report_rate(state, "voxels", members.size());
}

void simple_point_test(benchmark::State& state) {
  const std::vector<Cube27> cubes = cubes_of(pipeline().edges);
  for (auto _ : state)
    for (const Cube27 cube : cubes) benchmark::DoNotOptimize(is_simple(cube));
  report_rate(state, "voxels", cubes.size());
}

void thinning_pass(benchmark::State& state) {  // its decisions, without a deletion
  const Pipeline& p = pipeline();
  const std::vector<VoxelId> members = p.edges.members(p.esdf.layout);
  for (auto _ : state)
    for (const VoxelId id : members) {
      const Cube27 cube = cube_around(p.esdf.layout, p.edges, id);
      benchmark::DoNotOptimize(matches_deletion_template(cube) && is_simple(cube) &&
                               !is_curve_end(cube));
    }
  report_rate(state, "voxels", members.size());
}

void tracing(benchmark::State& state) {
  const Roadmap& roadmap = pipeline().roadmap;
  const double voxel = roadmap.esdf.voxel_size;
  const detail::DiagramCurves curves =
      detail::index_diagram(roadmap.esdf, roadmap.diagram.voxels, kRadius);
  const auto vertices = detail::select_vertices(curves, kRadius / voxel);
  for (auto _ : state) {
    const detail::DiagramFlood flood = detail::flood_from(curves, vertices);
    benchmark::DoNotOptimize(detail::follow_curves(curves, flood, 4.0 * kRadius / voxel));
  }
  report_rate(state, "voxels", curves.size());
}

BENCHMARK(copy_of_neighbourhoods)->Unit(benchmark::kMillisecond);
BENCHMARK(gathering_neighbourhoods)->Unit(benchmark::kMillisecond);
BENCHMARK(simple_point_test)->Unit(benchmark::kMillisecond);
BENCHMARK(thinning_pass)->Unit(benchmark::kMillisecond);
BENCHMARK(tracing)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ridgeway
