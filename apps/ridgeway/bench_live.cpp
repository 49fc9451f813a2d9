// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <memory>
#include <optional>

#include "arguments.hpp"
#include "bench.hpp"
#include "console.hpp"
#include "experiments/live_flight.hpp"
#include "interruption.hpp"
#include "live_table.hpp"
#include "recording.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"

namespace ridgeway::cli {
namespace {

struct BenchLiveOptions {
  ScanOptions scan;  // of which the volume is not asked for
  std::string output, recording;
  bool door = false;
  std::size_t changes = 0;
  LiveFlightConfig config;
};

/// Every frame of a recording.
void run_recording(const BenchLiveOptions& options, const Progress& progress,
                   std::vector<LiveScan>& scans) {
  const bool of_scans = kind_of_recording(options.recording) == RecordingKind::kScans;
  LiveConfig config = {.fusion = {.voxel_size = options.config.voxel_size},
                       .build = {.min_clearance = options.config.min_clearance,
                                 .max_distance = options.config.max_distance,
                                 .tangent_pairs = options.config.tangent_pairs}};
  if (of_scans) config.fusion.integrator = Integrator::kRayCasting;
  LiveRoadmap live(config);
  LiveJudge judge(config.build, options.config.verify_every);
  const auto show = [&](std::size_t of) {
    if (progress && !progress("live", static_cast<double>(scans.size()) / static_cast<double>(of)))
      throw Cancelled();
  };
  if (of_scans) {
    const ScanSequence sequence = open_scans(options.recording);
    for (const Scan& scan : sequence.scans) {
      show(sequence.scans.size());
      scans.push_back(
          judge.judge(live, live.integrate(read_scan(scan).points, scan.T_world_sensor)));
    }
    return;
  }
  const DepthSequence sequence = open_sequence(options.recording, {});
  for (const DepthFrame& frame : sequence.frames) {
    show(sequence.frames.size());
    const DepthImage image = read_frame(sequence, frame);
    scans.push_back(
        judge.judge(live, live.integrate(image, sequence.camera, frame.T_world_camera)));
  }
}

int run_changes(const BenchLiveOptions& options, const Globals& globals) {
  ProgressBar bar(globals);
  ChangeSets sets;
  const bool complete = completes(
      [&] { run_change_sets(options.changes, options.config.seed, bar.callback(), sets); });
  bar.clear();
  BenchTable table;
  table.add({{"change_sets", sets.done}, {"same_as_batch", sets.same}});
  return table.report(globals, options.output, "live_changes", {{"seed", options.config.seed}},
                      complete);
}

/// Adds what was counted of queries.
void add_queries(const LiveQueries& queries, BenchTable::Json& facts) {
  if (queries.asked == 0) return;
  const auto microseconds = [](const std::vector<double>& seconds) {
    return 1e6 * spread_of(seconds).median;
  };
  facts["queries"] = {{"asked", queries.asked},
                      {"solved", queries.solved},
                      {"wrong", queries.wrong},
                      {"median_us_meanwhile", microseconds(queries.meanwhile)},
                      {"median_us_alone", microseconds(queries.alone)}};
}

int report_scans(const std::vector<LiveScan>& scans, BenchTable::Json facts,
                 const BenchLiveOptions& options, const Globals& globals, bool complete) {
  const auto count = [&](bool LiveScan::*what) {
    return std::count_if(scans.begin(), scans.end(),
                         [&](const LiveScan& s) { return s.is_judged && s.*what; });
  };
  facts["scans"] = scans.size();
  facts["verified"] = count(&LiveScan::is_judged);
  facts["same_as_batch"] = count(&LiveScan::is_same);
  facts["voxel_size"] = options.config.voxel_size;
  facts["threads"] = globals.threads;
  if (complete) write_scans(scans, options.output);
  const int code = live_table(scans).report(globals, options.output, "live", facts, complete);
  if (!globals.json)
    for (const auto& [key, value] : facts.items()) print_row(key, value.dump());
  return code;
}

int run(const BenchLiveOptions& options, const Globals& globals) {
  if (!options.output.empty()) require_folder(options.output);
  if (options.changes > 0) return run_changes(options, globals);
  LiveFlightConfig config = options.config;
  config.scans = options.scan.scans;
  ProgressBar bar(globals);
  BenchTable::Json facts;
  LiveFlight flight;
  bool complete = true;
  if (options.door) {
    DoorResult door;
    complete = completes([&] {
      door = run_door({.voxel_size = config.voxel_size, .sigma = config.sigma, .seed = config.seed},
                      bar.callback());
    });
    facts = {{"world", "door"},
             {"has_path_first", door.has_path_first},
             {"scans_until_no_path", door.until_no_path},
             {"scans_until_path", door.until_path}};
    flight.scans = door.scans;
  } else if (!options.recording.empty()) {
    complete = completes([&] { run_recording(options, bar.callback(), flight.scans); });
    facts = {{"recording", options.recording}};
  } else {
    const World world = options.scan.load();
    complete = completes([&] { run_live_flight(world, config, bar.callback(), flight); });
    facts = {{"world", world.name}, {"copies", config.copies}};
    add_queries(flight.queries, facts);
  }
  bar.clear();
  facts["radius"] = config.min_clearance;
  facts["max_distance"] = config.max_distance;
  return report_scans(flight.scans, facts, options, globals, complete);
}

}  // namespace

void add_bench_live(Command& bench) {
  const auto options = std::make_shared<BenchLiveOptions>();
  LiveFlightConfig& config = options->config;
  Command command = bench.add(
      "live", "What a scan changes on a flight, and what an update costs against a batch build");
  const Option world =
      command.path("--world", options->scan.world, "World, .yaml (default: the house)");
  command.path("--recording", options->recording, "Frames of a recording in place of a flight")
      .excludes(world);
  command.flag("--door", options->door,
               "In place of a flight, a door that is closed and opened before a camera: after how "
               "many scans no path goes through it, and after how many one does");
  command.whole("--changes", options->changes, {0, 10'000'000},
                "In place of a flight, so many random sets of changes of small maps");
  command.whole("--scans", options->scan.scans, {1, 100'000}, "Depth images to fuse");
  command.whole("--verify", config.verify_every, {0, 1'000'000},
                "Build in batch after every so many scans and compare; 0: never");
  command.whole(
      "--copies", config.copies, {0, 1000},
      "Of the exact world, which the map has from the first, beside what is flown through");
  command.whole("--tangent-pairs", config.tangent_pairs, {0, 1'000'000},
                "Of places that batch builds learn the tangent graph from; 0: none");
  command.flag("--queries", config.queries, "Plan in another thread while the map is updated");
  command.number("--voxel-size", config.voxel_size, kLengths, "Metres");
  command.number("--clearance", config.min_clearance, kLengths, "Of the roadmap, metres");
  command.number("--max-distance", config.max_distance, kLengths, "Distances stop here, metres");
  command.number("--sigma", config.sigma, kLengthsFromZero,
                 "Gaussian noise on every range, metres");
  command.seed(config.seed, "Of places and noise");
  command.path("-o,--output", options->output,
               "Folder for live.json, live.csv, live_scans.csv and a chart (PNG, SVG)");
  command.footer("Example:\n  ridgeway bench live --threads 2");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
