// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <memory>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "experiments/live_flight.hpp"
#include "interruption.hpp"
#include "ridgeway/planning/check.hpp"

namespace ridgeway::cli {
namespace {

struct BenchLiveOptions {
  ScanOptions scan;  // of which the volume is not asked for
  std::string output;
  LiveFlightConfig config;
};

constexpr std::size_t kFirst = 9;  // scans before this one find little but the unknown

/// A row of the table: what a number of each scan is over the flight.
template <typename Value>
void add_row(BenchTable& table, const std::vector<LiveScan>& scans, const std::string& what,
             const Value& value) {
  std::vector<double> values;
  for (std::size_t i = std::min(kFirst, scans.size()); i < scans.size(); ++i)
    values.push_back(static_cast<double>(value(scans[i])));
  const Spread spread = spread_of(std::move(values));
  table.add({{"what", what}, {"median", spread.median}, {"p95", spread.p95}, {"max", spread.max}});
}

void add_counts(BenchTable& table, const std::vector<LiveScan>& scans) {
  const auto add = [&](const std::string& what, const auto& value) {
    add_row(table, scans, what, value);
  };
  add("known voxels", [](const LiveScan& s) { return s.known_voxels; });
  add("blocks", [](const LiveScan& s) { return s.map_blocks; });
  add("changed states", [](const LiveScan& s) { return s.update.changed_voxels; });
  add("flipped obstacles", [](const LiveScan& s) { return s.update.flipped_voxels; });
  add("added blocks", [](const LiveScan& s) { return s.update.added_blocks; });
  add("changed distances", [](const LiveScan& s) { return s.update.changed_distances; });
  add("in blocks", [](const LiveScan& s) { return s.update.changed_blocks; });
  const auto add_stage = [&](const std::string& what, StageChange LiveScan::*stage) {
    add(what, [stage](const LiveScan& s) { return (s.*stage).voxels; });
    add(what + ", changed", [stage](const LiveScan& s) { return (s.*stage).changed; });
    add(what + ", in blocks", [stage](const LiveScan& s) { return (s.*stage).blocks; });
  };
  add_stage("traversable", &LiveScan::traversable);
  add_stage("gvd", &LiveScan::gvd);
  add_stage("thick edges", &LiveScan::thick_edges);
  add_stage("thinned edges", &LiveScan::edges);
  add_stage("kernel", &LiveScan::kernel);
  add_stage("diagram", &LiveScan::diagram);
}

void add_times(BenchTable& table, const std::vector<LiveScan>& scans) {
  const auto add = [&](const std::string& what, const auto& seconds) {
    add_row(table, scans, "ms " + what, [&](const LiveScan& s) { return 1e3 * seconds(s); });
  };
  add("fusion", [](const LiveScan& s) { return s.update.fusion_seconds; });
  add("map", [](const LiveScan& s) { return s.update.map_seconds; });
  add("copy", [](const LiveScan& s) { return s.update.copy_seconds; });
  const auto add_stage = [&](const std::string& what, double BuildSeconds::*stage) {
    add(what, [stage](const LiveScan& s) { return s.update.build.seconds.*stage; });
    add(what + ", batch", [stage](const LiveScan& s) { return s.batch.*stage; });
  };
  add_stage("field", &BuildSeconds::esdf);
  add("ridges", [](const LiveScan& s) {
    const BuildSeconds& t = s.update.build.seconds;
    return t.gvd + t.edges + t.thin;
  });
  add("ridges, batch",
      [](const LiveScan& s) { return s.batch.gvd + s.batch.edges + s.batch.thin; });
  add_stage("kernel", &BuildSeconds::kernel);
  add_stage("graph", &BuildSeconds::graph);
  add_stage("attach", &BuildSeconds::attach);
  add_stage("tangents", &BuildSeconds::tangents);
  add_stage("all stages", &BuildSeconds::total);
  add("from scan to snapshot", [](const LiveScan& s) { return s.update.seconds; });
}

int run(const BenchLiveOptions& options, const Globals& globals) {
  LiveFlightConfig config = options.config;
  config.scans = options.scan.scans;
  const World world = options.scan.load();
  if (!options.output.empty()) require_folder(options.output);
  ProgressBar bar(globals);
  std::vector<LiveScan> scans;
  const bool complete = completes([&] { run_live_flight(world, config, bar.callback(), scans); });
  bar.clear();
  BenchTable table;
  add_counts(table, scans);
  add_times(table, scans);
  const auto same =
      std::count_if(scans.begin(), scans.end(), [](const LiveScan& s) { return s.is_same; });
  const BenchTable::Json facts = {{"world", world.name},
                                  {"scans", scans.size()},
                                  {"same_as_batch", same},
                                  {"voxel_size", config.voxel_size},
                                  {"radius", config.min_clearance},
                                  {"max_distance", config.max_distance},
                                  {"threads", globals.threads}};
  return table.report(globals, options.output, "live", facts, complete);
}

}  // namespace

void add_bench_live(Command& bench) {
  const auto options = std::make_shared<BenchLiveOptions>();
  LiveFlightConfig& config = options->config;
  Command command = bench.add(
      "live", "What a scan changes on a flight, and what an update costs against a batch build");
  command.path("--world", options->scan.world, "World, .yaml (default: the house)");
  command.whole("--scans", options->scan.scans, {1, 100'000}, "Depth images to fuse");
  command.number("--voxel-size", config.voxel_size, kLengths, "Metres");
  command.number("--clearance", config.min_clearance, kLengths, "Of the roadmap, metres");
  command.number("--max-distance", config.max_distance, kLengths, "Distances stop here, metres");
  command.number("--sigma", config.sigma, kLengthsFromZero,
                 "Gaussian noise on every range, metres");
  command.seed(config.seed, "Of places and noise");
  command.path("-o,--output", options->output, "Folder for live.json and live.csv");
  command.footer("Example:\n  ridgeway bench live --threads 2");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
