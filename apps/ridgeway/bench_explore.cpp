// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "experiments/exploration_flight.hpp"
#include "explore_options.hpp"
#include "interruption.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "ridgeway/pictures/picture.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;

struct BenchExploreOptions {
  std::vector<std::string> worlds;  // none, and no file: the three
  std::string file;
  std::optional<Point> start;  // in the file's world
  std::optional<Box> bounds;   // of it
  std::vector<std::string> planners = {"ridgeway", "frontier", "nbvp", "offline"};
  std::string output;
  int seeds = 5, cells = 10;
  ExploreSettings settings;
};

struct Place {
  World world;
  Point start;
  std::optional<Box> bounds = {};
};

/// The first place with so much room, in metres, along the wall from a corner.
Point start_with_room(const World& world, Point start, double room) {
  constexpr double kStep = 0.5;
  while (surface_distance(world, start).distance < room && start.x() < 100.0) start.x() += kStep;
  return start;
}

/// A world by its name, or that of the file.
Place place_of(const BenchExploreOptions& options, const std::string& world, std::uint64_t seed,
               double room) {
  if (world == options.file) return {load_world(world), *options.start, options.bounds};
  if (world == "maze") return {make_maze({.cells = options.cells, .seed = seed}), {1.5, 1.5, 1.25}};
  if (world == "hall") {
    const World hall = make_hall({.seed = seed});
    return {hall, start_with_room(hall, {1.5, 1.5, 1.5}, room)};
  }
  return {make_house(), {1.2, 1.2, 1.5}};
}

/// What is flown: names, and the file.
std::vector<std::string> worlds_of(const BenchExploreOptions& options) {
  if (options.file.empty() != !options.start)
    throw InputError("--start", "goes with --world", "give both or none");
  if (options.file.empty() && options.bounds)
    throw InputError("--bounds", "are of a --world", "give one, or no bounds");
  if (options.worlds.empty() && options.file.empty()) return {"maze", "hall", "house"};
  std::vector<std::string> worlds = options.worlds;
  if (!options.file.empty()) worlds.push_back(options.file);
  return worlds;
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Of one part of all decisions, or of the whole; at scans in between nothing is decided.
Json milliseconds_of(const ExplorationFlight& flight, double ExplorationSeconds::*part) {
  std::vector<double> milliseconds;
  for (const ExplorationSample& sample : flight.samples)
    if (sample.seconds.total > 0.0) milliseconds.push_back(1e3 * sample.seconds.*part);
  const Spread spread = spread_of(milliseconds);
  return {{"median", spread.median}, {"p95", spread.p95}, {"max", spread.max}};
}

Json row_of(const ExplorationFlight& flight) {
  Json seconds, lengths;
  for (const int percent : {90, 95, 99}) {
    seconds[std::to_string(percent)] = number_or_null(flight.seconds_to(0.01 * percent));
    lengths[std::to_string(percent)] = number_or_null(flight.length_to(0.01 * percent));
  }
  return {{"end", std::string(flight.end_name())},
          {"seconds_to", seconds},
          {"length_to", lengths},
          {"seconds", flight.seconds},
          {"length", flight.length},
          {"coverage", flight.coverage},
          {"collisions", flight.collisions},
          {"nearest", flight.nearest},
          {"stops", flight.stops},
          {"decision_milliseconds", milliseconds_of(flight, &ExplorationSeconds::total)},
          {"frontiers_milliseconds", milliseconds_of(flight, &ExplorationSeconds::frontiers)},
          {"views_milliseconds", milliseconds_of(flight, &ExplorationSeconds::views)},
          {"tour_milliseconds", milliseconds_of(flight, &ExplorationSeconds::tour)},
          {"trajectory_milliseconds", milliseconds_of(flight, &ExplorationSeconds::trajectory)}};
}

std::string picture_name(const std::string& world, int seed, const std::string& planner) {
  return "explore_" + world + "_" + std::to_string(seed) + "_" + planner;
}

void draw(const ExplorationFlight& flight, const std::string& folder, const std::string& name) {
  PictureConfig picture;
  picture.title = name;
  picture.diagram = false;
  picture.path_label = "flight";
  if (flight.roadmap)
    draw_floor_plan(*flight.roadmap, flight.path, folder + "/" + name + ".png", picture);
}

int run(const BenchExploreOptions& options, const Globals& globals) {
  const std::vector<std::string> worlds = worlds_of(options);
  std::vector<std::string> names;
  names.reserve(worlds.size());
  for (const std::string& world : worlds)
    names.push_back(std::filesystem::path(world).stem().string());
  require_distinct(std::move(names));
  if (!options.output.empty()) require_folder(options.output);
  BenchTable table;
  ProgressBar bar(globals);
  const bool complete = completes([&] {
    for (const std::string& world : worlds)
      for (int seed = 1; seed <= options.seeds; ++seed)
        for (const std::string& planner : options.planners) {
          ExploreSettings settings = options.settings;
          settings.planner = planner;
          settings.of_frontiers.clear();  // given for the planners that have them
          ExplorationFlightConfig config = settings.flight();
          const Place place =
              place_of(options, world, static_cast<std::uint64_t>(seed), config.free_radius());
          config.start = place.start;
          config.bounds = place.bounds;
          config.seed = static_cast<std::uint64_t>(seed);
          const ExplorationFlight flight = explore(place.world, config, bar.callback());
          const std::string name = std::filesystem::path(world).stem().string();
          Json row = {{"world", name}, {"seed", seed}, {"planner", planner}};
          row.update(row_of(flight));
          table.add(row);
          if (!options.output.empty())
            draw(flight, options.output, picture_name(name, seed, planner));
        }
  });
  bar.clear();
  const ExplorationFlightConfig& config = options.settings.config;
  const Json facts = {{"voxel_size", config.voxel_size},
                      {"radius", config.radius},
                      {"max_speed", config.explorer.motion.max_speed},
                      {"max_acceleration", config.explorer.motion.max_acceleration},
                      {"scan_rate", config.scan_rate}};
  return table.report(globals, options.output, "explore", facts, complete);
}

}  // namespace

void add_bench_explore(Command& bench) {
  const auto options = std::make_shared<BenchExploreOptions>();
  Command command = bench.add(
      "explore", "A simulated drone maps worlds by itself: time, length and safety by planner");
  command.choices("--worlds", options->worlds, {"maze", "hall", "house"},
                  "Worlds to map (default: all, unless another is given)");
  command.path("--world", options->file, "World to map, .yaml; its seeds are of the noise alone");
  command.point("--start", options->start, "Where the drone is at first in that --world, x,y,z");
  command.box("--bounds", options->bounds,
              "What of that --world is to be mapped, x0,y0,z0,x1,y1,z1 (default: its enclosure)");
  command.choices("--planners", options->planners, {"ridgeway", "frontier", "nbvp", "offline"},
                  "Who decides where to fly; offline: a tour by one that knows the world");
  command.whole("--seeds", options->seeds, {1, 1000}, "Of worlds and noise: 1 up to this");
  command.whole("--cells", options->cells, {2, 100}, "Of the maze, along each side");
  ExploreSettings& settings = options->settings;
  ExplorationFlightConfig& config = settings.config;
  command.number("--voxel-size", config.voxel_size, kLengths, "Of the map, metres");
  command.number("--radius", config.radius, kLengths, "Of the drone, metres");
  command.number("--sigma", settings.sigma, kLengthsFromZero,
                 "Gaussian noise on every range, metres");
  command.number("--scan-rate", config.scan_rate, {1e-3, 1e3}, "Images a second");
  command.number("--longest", config.longest, {.least = 0.0, .most = 1e6, .above = true},
                 "A flight is cut off then, seconds");
  command.path("-o,--output", options->output,
               "Folder for explore.json, explore.csv and a picture of each flight");
  command.footer("Example:\n  ridgeway bench explore --worlds house --seeds 1");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
