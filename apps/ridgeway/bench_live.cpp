// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "bench.hpp"
#include "console.hpp"
#include "experiments/live_flight.hpp"
#include "experiments/process_memory.hpp"
#include "interruption.hpp"
#include "live_table.hpp"
#include "recording.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/planning/check.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"
#include "sensing/world_generators.hpp"
#include "threads.hpp"

namespace ridgeway::cli {
namespace {

struct BenchLiveOptions {
  std::vector<std::string> worlds, files, recordings;  // none of them: the house
  std::string output;
  std::size_t changes = 0;
  LiveFlightConfig config;

  BenchLiveOptions() { config.scans = 200; }
};

/// Every frame of a recording.
void run_recording(const std::string& folder, const LiveFlightConfig& how, const Progress& progress,
                   LiveFlight& flight) {
  const bool of_scans = kind_of_recording(folder) == RecordingKind::kScans;
  LiveConfig config = {.fusion = {.voxel_size = how.voxel_size},
                       .build = {.min_clearance = how.min_clearance,
                                 .max_distance = how.max_distance,
                                 .tangent_pairs = how.tangent_pairs}};
  if (of_scans) config.fusion.integrator = Integrator::kRayCasting;
  const ScanSequence clouds = of_scans ? open_scans(folder) : ScanSequence{};
  const DepthSequence images = of_scans ? DepthSequence{} : open_sequence(folder, {});
  const std::size_t frames = of_scans ? clouds.scans.size() : images.frames.size();
  flight.scans.reserve(frames);
  const std::uint64_t before = detail::allocated_bytes();
  LiveRoadmap live(config);
  auto judge = std::make_unique<LiveJudge>(config.build, how.verify_every);
  for (std::size_t i = 0; i < frames; ++i) {
    if (progress && !progress("live", static_cast<double>(i) / static_cast<double>(frames)))
      throw Cancelled();
    flight.scans.push_back(judge->judge(
        live,
        of_scans ? live.integrate(read_scan(clouds.scans[i]).points, clouds.scans[i].T_world_sensor)
                 : live.integrate(read_frame(images, images.frames[i]), images.camera,
                                  images.frames[i].T_world_camera)));
  }
  judge.reset();
  flight.memory_ratio = memory_ratio(live, config.build, before);
}

int run_changes(const BenchLiveOptions& options, const Globals& globals) {
  ProgressBar bar(globals);
  ChangeSets sets;
  const bool complete = completes(
      [&] { run_change_sets(options.changes, options.config.seed, bar.callback(), sets); });
  bar.clear();
  BenchTable table;
  table.add({{"change_sets", sets.done},
             {"same_as_batch", sets.same},
             {"without_roadmap", sets.without_roadmap}});
  return table.report(globals, options.output, "live_changes", {{"seed", options.config.seed}},
                      complete);
}

using Json = BenchTable::Json;

World world_of(const std::string& name, std::uint64_t seed) {
  if (name == "maze") return make_maze({.seed = seed});
  if (name == "hall") return make_hall({.seed = seed});
  return make_house();
}

Json null_if_none(const std::vector<double>& values, double scale) {
  return values.empty() ? Json() : Json(scale * spread_of(values).median);
}

/// What a flight or a recording came to, in a line. Times are those from the tenth scan on.
Json row_of(const std::string& name, const LiveFlight& flight) {
  std::vector<double> all, field, batch;
  std::size_t verified = 0, identical = 0;
  for (const LiveScan& scan : later_scans(flight.scans)) {
    all.push_back(scan.update.seconds);
    field.push_back(scan.update.build.seconds.esdf);
    if (scan.is_judged) batch.push_back(scan.batch.total);
  }
  for (const LiveScan& scan : flight.scans) {
    verified += scan.is_judged;
    identical += scan.is_judged && scan.is_same;
  }
  const Spread spread = spread_of(all);
  const LiveQueries& queries = flight.queries;
  return {{"recording", name},
          {"scans", flight.scans.size()},
          {"verified", verified},
          {"identical", identical},
          {"milliseconds",
           {{"median", 1e3 * spread.median}, {"p95", 1e3 * spread.p95}, {"p99", 1e3 * spread.p99}}},
          {"field_milliseconds", {{"median", null_if_none(field, 1e3)}}},
          {"batch_milliseconds", {{"median", null_if_none(batch, 1e3)}}},
          {"queries", queries.asked},
          {"query_violations", queries.wrong},
          {"query_microseconds",
           {{"live", null_if_none(queries.meanwhile, 1e6)},
            {"static", null_if_none(queries.alone, 1e6)}}},
          {"memory_ratio", flight.memory_ratio ? Json(*flight.memory_ratio) : Json()}};
}

std::string name_of_file(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}
std::string name_of_folder(const std::string& folder) {
  return (std::filesystem::path(folder) / "").parent_path().filename().string();
}

/// All that is flown and replayed, one after the other.
class LiveBench {
 public:
  LiveBench(const BenchLiveOptions& options, const Globals& globals)
      : options_(options), globals_(globals), bar_(globals) {}

  void run() {
    std::vector<std::string> worlds = options_.worlds;
    if (worlds.empty() && options_.files.empty() && options_.recordings.empty()) worlds = {"house"};
    std::vector<std::string> names = worlds;
    for (const std::string& file : options_.files) names.push_back(name_of_file(file));
    for (const std::string& folder : options_.recordings) names.push_back(name_of_folder(folder));
    require_distinct(std::move(names));
    for (const std::string& name : worlds)
      if (name == "door")
        add_door();
      else
        add_flight(name, world_of(name, options_.config.seed));
    for (const std::string& file : options_.files) add_flight(name_of_file(file), load_world(file));
    for (const std::string& folder : options_.recordings)
      add(name_of_folder(folder), [&](LiveFlight& flight) {
        run_recording(folder, options_.config, bar_.callback(), flight);
      });
  }

  int report(bool complete) {
    bar_.clear();
    facts_["copies"] = options_.config.copies;
    facts_["radius"] = options_.config.min_clearance;
    facts_["max_distance"] = options_.config.max_distance;
    facts_["voxel_size"] = options_.config.voxel_size;
    facts_["threads"] = threads_to_use(globals_);
    return table_.report(globals_, options_.output, "live", facts_, complete);
  }

 private:
  /// What was done before an interruption counts too.
  template <typename Fly>
  void add(const std::string& name, const Fly& fly) {
    LiveFlight flight;
    try {
      fly(flight);
    } catch (const Cancelled&) {  // what is written is complete
      if (!flight.scans.empty()) show(name, flight);
      throw;
    }
    show(name, flight);
    write_scans(flight.scans, options_.output, "live_" + name);
  }

  void show(const std::string& name, const LiveFlight& flight) {
    bar_.clear();
    const BenchTable stages = live_table(flight.scans);
    if (!globals_.json) stages.print(name);
    facts_["stages"][name] = stages.rows();
    table_.add(row_of(name, flight));
  }

  void add_flight(const std::string& name, const World& world) {
    add(name, [&](LiveFlight& flight) {
      run_live_flight(world, options_.config, bar_.callback(), flight);
    });
  }

  /// With a number of scans of its own, without neighbours and queries.
  void add_door() {
    const LiveFlightConfig& config = options_.config;
    add("door", [&](LiveFlight& flight) {
      DoorResult door = run_door({.voxel_size = config.voxel_size,
                                  .min_clearance = config.min_clearance,
                                  .max_distance = config.max_distance,
                                  .sigma = config.sigma,
                                  .seed = config.seed,
                                  .verify_every = config.verify_every},
                                 bar_.callback());
      facts_["door"] = {{"has_path_first", door.has_path_first},
                        {"scans_until_no_path", door.until_no_path},
                        {"scans_until_path", door.until_path}};
      flight = std::move(door.flight);
    });
  }

  const BenchLiveOptions& options_;
  const Globals& globals_;
  ProgressBar bar_;
  BenchTable table_;
  Json facts_;
};

int run(const BenchLiveOptions& options, const Globals& globals) {
  if (!options.output.empty()) require_folder(options.output);
  if (options.changes > 0) return run_changes(options, globals);
  LiveBench bench(options, globals);
  const bool complete = completes([&] { bench.run(); });
  return bench.report(complete);
}

}  // namespace

void add_bench_live(Command& bench) {
  const auto options = std::make_shared<BenchLiveOptions>();
  LiveFlightConfig& config = options->config;
  Command command = bench.add(
      "live", "What a scan changes on a flight, and what an update costs against a batch build");
  command.choices(
      "--worlds", options->worlds, {"house", "maze", "hall", "door"},
      "Worlds to fly through (default: house, unless others are given); door: one that "
      "is closed and opened before a camera, and "
      "after how many scans no path goes through it, and one does (120 scans; --scans, --copies, "
      "--queries and --tangent-pairs are not for it)");
  command.paths("--world", options->files, "World to fly through, .yaml; may be repeated");
  command.paths("--recording", options->recordings, "Recording to replay; may be repeated");
  command.whole("--changes", options->changes, {0, 10'000'000},
                "In place of all that, so many random sets of changes of small maps");
  command.whole("--scans", config.scans, {1, 100'000}, "Depth images of a flight");
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
               "Folder for live.json, live.csv, and live_NAME.csv with a chart (PNG, SVG) of each; "
               "with --changes for live_changes.json and live_changes.csv");
  command.footer("Example:\n  ridgeway bench live --worlds house,maze,door --verify 10 -o results");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
