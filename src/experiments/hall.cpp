// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "hall.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/clock.hpp"
#include "common/random.hpp"
#include "common/require.hpp"
#include "memory_traffic.hpp"
#include "process_memory.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "sensing/poses.hpp"

namespace ridgeway {
namespace {

using detail::seconds_now;

double median_of(std::vector<double> values) { return spread_of(std::move(values)).median; }

struct Query {
  Point start, goal;
};

/// Between the centres of random traversable voxels.
std::vector<Query> draw_queries(const Roadmap& roadmap, std::size_t count, std::uint64_t seed) {
  const EsdfMap& esdf = roadmap.esdf;
  const std::vector<VoxelId> places =
      traversable_voxels(esdf, roadmap.min_clearance).members(esdf.layout);
  Random random(seed);
  const auto place = [&] {
    const VoxelIndex voxel = esdf.layout.index_of(places[random.below(places.size())]);
    return to_world(esdf, centre_of(voxel, esdf.voxel_size));
  };
  std::vector<Query> queries;
  while (queries.size() < count) {
    const Point start = place();
    queries.push_back({start, place()});
  }
  return queries;
}

StageNumbers stages_of(const BuildSeconds& s) {
  const double graph = s.gvd + s.edges + s.thin + s.kernel + s.graph;
  return {s.esdf, s.gvd, s.edges, s.thin, s.kernel, s.graph, s.attach, s.tangents, graph, s.total};
}

/// All that is measured of one map with one number of threads.
class Measurement {
 public:
  Measurement(const HallExperimentConfig& config, const HallMap& map, int threads)
      : config_(config), make_(map.make) {
    row_.map = map.name;
    row_.threads = threads;
  }

  /// Peak memory is that of a process that makes the map and builds once, no more. The mark of
  /// this one could be set back between runs, but the allocator keeps some of what was freed in
  /// other threads, up to a sixth of the next map's peak.
  void measure_memory() {
    row_.peak_memory = detail::peak_memory_of([&] { build_once(make_()); });
    if (!row_.peak_memory) build_once(make_());  // throws what is wrong, before the long work
  }

  Roadmap build(const Progress& progress) {
    OccupancyMap map = make_();
    row_.voxel_size = map.voxel_size;
    row_.min_clearance = min_clearance_for(map);
    detail::release_freed_memory();
    BuildResult built = build_once(std::move(map), progress);
    runs_.push_back(stages_of(built.report.seconds));
    row_.counts = built.report;
    row_.vertices = built.roadmap.graph.vertices.size();
    row_.edges = built.roadmap.graph.edges.size();
    has_near_sites_ = built.roadmap.esdf.site.has_near_only();
    return std::move(built.roadmap);
  }

  void copy() {
    row_.copy_bandwidth = with_threads(
        row_.threads, [&] { return detail::copy_bandwidth(config_.copy_bytes, config_.repeat); });
  }

  /// Queries on the roadmap in memory, and the first one on the roadmap from its file.
  void query(Roadmap roadmap, const RoadmapStore& store) {
    const std::vector<Query> queries = draw_queries(roadmap, config_.queries, config_.seed);
    std::size_t first = 0;
    with_threads(row_.threads, [&] { first = run_batch(roadmap, queries); });
    if (!store.load) return;
    if (store.save) store.save(roadmap);
    roadmap = {};
    with_threads(row_.threads, [&] { answer_first(store, queries[first]); });
  }

  HallRow row() const {
    HallRow row = row_;
    for (const StageName& stage : kStageNames) {
      std::vector<double> seconds;
      for (const StageNumbers& run : runs_) seconds.push_back(run.*stage.number);
      row.seconds.*stage.number = median_of(std::move(seconds));
    }
    row.voxels = detail::voxels_walked(row.counts);
    row.bytes = detail::least_traffic(row.counts, has_near_sites_);
    return row;
  }

 private:
  double min_clearance_for(const OccupancyMap& map) const {
    return std::max(config_.min_clearance, 2.0 * map.voxel_size);
  }

  /// Its seconds in total are the wall clock's.
  BuildResult build_once(OccupancyMap map, const Progress& progress = {}) {
    return with_threads(row_.threads, [&] {
      const BuildConfig config{.min_clearance = min_clearance_for(map)};
      const double begin = seconds_now();
      BuildResult result = build_roadmap(std::move(map), config, progress);
      result.report.seconds.total = seconds_now() - begin;
      return result;
    });
  }

  /// Returns which query to ask first of a roadmap just loaded: one that has an answer.
  std::size_t run_batch(const Roadmap& roadmap, const std::vector<Query>& queries) {
    std::vector<std::uint8_t> ok(queries.size());
    std::vector<double> seconds;
    for (int run = 0; run < config_.repeat; ++run) {
      const double begin = seconds_now();
      parallel_for_each_index(queries.size(), [&](std::size_t i) {
        ok[i] = plan(roadmap, queries[i].start, queries[i].goal).ok();
      });
      seconds.push_back(seconds_now() - begin);
    }
    row_.batch_seconds = median_of(std::move(seconds));
    row_.solved = static_cast<std::size_t>(std::count(ok.begin(), ok.end(), 1));
    const auto first = std::find(ok.begin(), ok.end(), 1);
    return first == ok.end() ? 0 : static_cast<std::size_t>(first - ok.begin());
  }

  void answer_first(const RoadmapStore& store, const Query& query) {
    std::vector<double> load, plan_first, both;
    for (int run = 0; run < config_.repeat; ++run) {
      detail::release_freed_memory();
      const double begin = seconds_now();
      const Roadmap roadmap = store.load();
      load.push_back(seconds_now() - begin);
      plan(roadmap, query.start, query.goal);
      both.push_back(seconds_now() - begin);
      plan_first.push_back(both.back() - load.back());
    }
    row_.load_seconds = median_of(std::move(load));
    row_.first_query_seconds = median_of(std::move(plan_first));
    row_.first_answer_seconds = median_of(std::move(both));
  }

  const HallExperimentConfig& config_;
  const std::function<OccupancyMap()> make_;
  HallRow row_;
  bool has_near_sites_ = false;  // the roadmap's
  std::vector<StageNumbers> runs_;
};

std::vector<HallMap> all_maps(const HallExperimentConfig& config,
                              const std::vector<HallMap>& other_maps) {
  std::vector<HallMap> maps;
  const World world = make_hall(config.hall);
  for (const double voxel_size : config.voxel_sizes)
    maps.push_back({"hall", [world, voxel_size] {
                      const PoseSampling inside = sampling_inside(world);
                      return occupancy_of(world, voxel_size, {inside.low, inside.high});
                    }});
  maps.insert(maps.end(), other_maps.begin(), other_maps.end());
  return maps;
}

}  // namespace

double HallRow::bandwidth_fraction(double StageNumbers::*stage) const {
  return bytes.*stage / (seconds.*stage * copy_bandwidth);
}

void HallExperimentConfig::validate() const {
  hall.validate();
  using detail::require;
  if (voxel_sizes.empty()) throw InputError("voxel_sizes", "is empty", "give at least one");
  for (const double voxel_size : voxel_sizes)
    require(voxel_size > 0.0 && std::isfinite(voxel_size), "voxel_sizes", voxel_size,
            "give metres, above 0");
  require(min_clearance > 0.0 && std::isfinite(min_clearance), "min_clearance", min_clearance,
          "give metres, above 0");
  if (threads.empty()) throw InputError("threads", "is empty", "give at least one number");
  for (const int count : threads) require(count >= 1, "threads", count, "give 1 or more");
  require(repeat >= 1, "repeat", repeat, "give 1 or more");
  require(queries >= 1, "queries", queries, "give 1 or more");
  require(copy_bytes >= 1, "copy_bytes", copy_bytes, "give 1 or more");
}

std::vector<HallRow> run_hall(const HallExperimentConfig& config,
                              const std::vector<HallMap>& other_maps, const RoadmapStore& store,
                              const Progress& progress) {
  std::vector<HallRow> rows;
  run_hall(config, other_maps, store, progress, rows);
  return rows;
}

void run_hall(const HallExperimentConfig& config, const std::vector<HallMap>& other_maps,
              const RoadmapStore& store, const Progress& progress, std::vector<HallRow>& rows) {
  rows.clear();
  config.validate();
  const std::vector<HallMap> maps = all_maps(config, other_maps);
  std::vector<Measurement> all;
  for (const HallMap& map : maps)
    for (const int threads : config.threads) all.emplace_back(config, map, threads);
  const auto say = [&](const std::string& stage, std::size_t part, double of) {
    if (progress && !progress(stage, static_cast<double>(part) / of)) throw Cancelled();
  };
  // First, while this process is small and has no threads; the maps that may be bad before others.
  for (std::size_t i = all.size(); i-- > 0;) {
    say("memory", 0, 1.0);
    all[i].measure_memory();
  }
  const std::size_t ways = config.threads.size();
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const std::span<Measurement> own = std::span(all).subspan(m * ways, ways);
    for (Measurement& measurement : own) measurement.copy();
    for (int run = 0; run < config.repeat; ++run) {
      say(maps[m].name, m, static_cast<double>(maps.size()));
      for (Measurement& measurement : own) {
        Roadmap roadmap = measurement.build(progress);
        if (run + 1 == config.repeat) measurement.query(std::move(roadmap), store);
      }
    }
    for (const Measurement& measurement : own) rows.push_back(measurement.row());
  }
}

}  // namespace ridgeway
