// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bench_data.hpp"

#include "common/random.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {
namespace {

Pipeline run_all() {
  Pipeline p;
  p.map = load_map(RIDGEWAY_DATA_DIR "/fr_079.bt", {});
  p.map.origin = {};  // so that the same points do for queries and for kernels of the local frame
  p.esdf = compute_esdf(p.map, {});
  p.traversable = traversable_voxels(p.esdf, kRadius);
  p.gvd = compute_gvd(p.esdf, p.traversable);
  p.edges = extract_edges(p.esdf, p.gvd);
  p.basins = find_basins(p.esdf, p.traversable, kRadius);
  p.kernel = compute_kernel(p.esdf, p.traversable, p.basins);
  p.roadmap = build_roadmap(p.map, {.min_clearance = kRadius}).roadmap;
  return p;
}

std::vector<Query> draw_queries(std::size_t count) {
  const std::vector<Point> places = random_places(8 * count);
  std::vector<Query> queries;
  for (std::size_t i = 0; i + 1 < places.size() && queries.size() < count; i += 2)
    if (plan(pipeline().roadmap, places[i], places[i + 1], {.shorten = false}).ok())
      queries.emplace_back(places[i], places[i + 1]);
  return queries;
}

}  // namespace

const Pipeline& pipeline() {
  static const Pipeline all = run_all();
  return all;
}

const std::vector<Query>& solvable_queries() {
  static const std::vector<Query> queries = draw_queries(500);
  return queries;
}

std::vector<Point> random_places(std::size_t count) {
  const EsdfMap& esdf = pipeline().esdf;
  const std::vector<VoxelId> voxels = pipeline().traversable.members(pipeline().esdf.layout);
  Random random(1);
  std::vector<Point> places;
  while (places.size() < count)
    places.push_back(
        centre_of(esdf.layout.index_of(voxels[random.below(voxels.size())]), esdf.voxel_size));
  return places;
}

void report_rate(benchmark::State& state, const char* what, std::size_t in_an_iteration) {
  const double all = static_cast<double>(in_an_iteration) * static_cast<double>(state.iterations());
  state.counters[what] = benchmark::Counter(all, benchmark::Counter::kIsRate);
}

}  // namespace ridgeway
