// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "experiments/flights.hpp"
#include "flight_picture.hpp"
#include "interruption.hpp"
#include "pictures/scatter.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "sensing/poses.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;
namespace fs = std::filesystem;

struct BenchTrajectoryOptions {
  std::vector<std::string> files, worlds = {"maze", "hall"};
  double voxel_size = 0.1;
  std::string output;
  FlightsConfig config;
};

struct NamedMap {
  std::string name;
  OccupancyMap map;
};

OccupancyMap map_of(const std::string& world_name, const BenchTrajectoryOptions& options) {
  const std::uint64_t seed = options.config.seed;
  const World world = world_name == "maze" ? make_maze({.seed = seed}) : make_hall({.seed = seed});
  const PoseSampling inside = sampling_inside(world);
  return occupancy_of(world, options.voxel_size, {inside.low, inside.high});
}

/// The worlds, then the files, as they are named. Throws InputError for no map at all, or two of
/// one name.
std::vector<NamedMap> load_maps(const BenchTrajectoryOptions& options) {
  std::vector<NamedMap> maps;
  for (const std::string& world : options.worlds)
    if (world != "none") maps.push_back({world, map_of(world, options)});
  for (const fs::path file : options.files) maps.push_back({file.stem().string(), load_map(file)});
  if (maps.empty()) throw InputError("--worlds none", "leaves no map", "name a map's file too");
  std::vector<std::string> names;
  names.reserve(maps.size());
  for (const NamedMap& map : maps) names.push_back(map.name);
  require_distinct(std::move(names));
  return maps;
}

Json median_and_p95(const Spread& spread) {
  return {{"median", spread.median}, {"p95", spread.p95}};
}

Json row_of(const std::string& name, const FlightsResult& result) {
  Json steps;
  for (std::size_t i = 0; i < result.steps.size(); ++i)
    steps[std::string(name_of(static_cast<TrajectoryStep>(i)))] = result.steps[i];
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) /
           static_cast<double>(std::max<std::size_t>(1, result.flights.size()));
  };
  return {{"map", name},
          {"queries", result.flights.size()},
          {"solved", result.solved},
          {"violations", result.violations},
          {"path_length", median_and_p95(result.path_length)},
          {"length_over_path", median_and_p95(result.length_over_path)},
          {"duration", median_and_p95(result.duration)},
          {"duration_over_bound", median_and_p95(result.over_bound)},
          {"duration_over_stop_and_go", median_and_p95(result.over_stop_and_go)},
          {"duration_over_trapezoid", median_and_p95(result.over_trapezoid)},
          {"longer_than_stop_and_go", result.longer_than_stop_and_go},
          {"straight", result.straight},
          {"longer_than_trapezoid", result.longer_than_trapezoid},
          {"seconds",
           {{"median", result.seconds.median},
            {"p95", result.seconds.p95},
            {"optimise", result.optimise_seconds.median},
            {"verify", result.verify_seconds.median}}},
          {"seconds_to_30_m", median_and_p95(result.near_seconds)},
          {"fallbacks", result.fallbacks()},
          {"steps", steps},
          {"plain_spline",
           {{"success", share(result.plain_holds)},
            {"duration_over_flight", result.plain_over_flight.median}}}};
}

/// The longest of those that took no stop, or of all.
const Flight& flight_to_draw(const std::vector<Flight>& flights) {
  return *std::max_element(flights.begin(), flights.end(), [](const Flight& a, const Flight& b) {
    const auto rank = [](const Flight& f) {
      return std::pair(f.flown.ok() && f.flown.stops == 0, f.path_length);
    };
    return rank(a) < rank(b);
  });
}

void draw(const NamedMap& map, const FlightsResult& result, const BenchTrajectoryOptions& options) {
  if (result.solved == 0) return;
  const Flight& flight = flight_to_draw(result.flights);
  TrajectoryConfig config;
  config.radius = options.config.min_clearance;
  config.motion = options.config.motion;
  for (const char* extension : {".png", ".svg"})
    draw_flight(result.roadmap, flight.path, flight.flown, config,
                fs::path(options.output) / ("trajectory_" + map.name + extension), map.name);
}

/// Duration over the bound against the length of the path.
ScatterSeries series_of(const std::string& name, const FlightsResult& result,
                        const MotionLimits& limits) {
  ScatterSeries series{name, {}};
  const double v = limits.max_speed, a = limits.max_acceleration;
  for (const Flight& flight : result.flights)
    if (flight.flown.ok() && flight.path_length >= v * v / a)
      series.points.emplace_back(flight.path_length,
                                 flight.flown.duration / (flight.path_length / v + v / a));
  return series;
}

void draw_durations(std::vector<ScatterSeries> series, const fs::path& folder) {
  constexpr std::size_t kMostSeries = 8;
  std::erase_if(series, [](const ScatterSeries& s) { return s.points.empty(); });
  if (series.size() > kMostSeries) series.resize(kMostSeries);
  if (series.empty()) return;
  ScatterChart chart;
  chart.title = "Flights against one trapezoidal profile over all of the path";
  chart.x_label = "length of the path L (m)";
  chart.y_label = "duration / (L / v + v / a)";
  chart.series = std::move(series);
  for (const char* name : {"trajectory_durations.png", "trajectory_durations.svg"})
    draw_scatter(chart, folder / name);
}

int run(const BenchTrajectoryOptions& options, const Globals& globals) {
  options.config.validate();
  if (!options.output.empty()) require_folder(options.output);
  BenchTable table;
  std::vector<ScatterSeries> series;
  ProgressBar bar(globals);
  const bool complete = completes([&] {
    for (const NamedMap& map : load_maps(options)) {
      const FlightsResult result = run_flights(map.map, options.config, bar.callback());
      table.add(row_of(map.name, result));
      series.push_back(series_of(map.name, result, options.config.motion));
      if (!options.output.empty()) draw(map, result, options);
    }
  });
  bar.clear();
  if (complete && !options.output.empty()) draw_durations(std::move(series), options.output);
  return table.report(globals, options.output, "trajectory",
                      {{"seed", options.config.seed},
                       {"radius", options.config.min_clearance},
                       {"max_speed", options.config.motion.max_speed},
                       {"max_acceleration", options.config.motion.max_acceleration}},
                      complete);
}

}  // namespace

void add_bench_trajectory(Command& bench) {
  const auto options = std::make_shared<BenchTrajectoryOptions>();
  FlightsConfig& config = options->config;
  Command command = bench.add(
      "trajectory", "Flights along planned paths: success, duration, time, before a judge");
  command.paths("maps", options->files, "Maps to fly on too, as `ridgeway build` reads them");
  command.choices("--worlds", options->worlds, {"maze", "hall", "none"},
                  "Simulated worlds to fly in");
  command.number("--voxel-size", options->voxel_size, kLengths, "Of the worlds, metres");
  command.number("--min-clearance", config.min_clearance, kLengths,
                 "And radius of the robot, metres");
  command.whole("--queries", config.queries, {1, 100'000},
                "On each map, of starts and goals with a path");
  command.number("--max-speed", config.motion.max_speed, kMotions, "Metres a second");
  command.number("--max-acceleration", config.motion.max_acceleration, kMotions,
                 "Metres a second^2");
  command.path("-o,--output", options->output,
               "Folder for trajectory.json, trajectory.csv and the pictures (PNG, SVG)");
  command.seed(config.seed, "Of worlds, starts and goals");
  command.footer("Example:\n  ridgeway bench trajectory data/fr_079.bt -o results");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
