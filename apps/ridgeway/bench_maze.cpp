// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "ridgeway/experiments/maze.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;

struct Options {
  std::string output;
  MazeExperimentConfig config;
};

BenchTable table_of(const MazeResult& result) {
  BenchTable table;
  const double ours = result.rows.back().seconds.median;
  for (const MazeRow& row : result.rows)
    table.add({{"planner", row.planner},
               {"queries", row.queries},
               {"solved", row.solved},
               {"seconds", {{"median", row.seconds.median}, {"p95", row.seconds.p95}}},
               {"seconds_over_graph", ours > 0.0 ? row.seconds.median / ours : 0.0},
               {"length", {{"median", row.length.median}}},
               {"length_over_esdf",
                {{"median", row.length_over_esdf.median}, {"p95", row.length_over_esdf.p95}}},
               {"vertices", {{"median", row.vertices.median}}},
               {"single",
                {{"seconds", row.single_seconds},
                 {"length", row.single_length},
                 {"vertices", row.single_vertices}}}});
  return table;
}

/// All planners' ways from corner to corner over the maze.
void draw_paths(const MazeResult& result, const std::filesystem::path& folder) {
  PictureConfig picture;
  picture.title = "From corner to corner, by every planner";
  picture.diagram = picture.graph = false;
  for (const MazeRow& row : result.rows) picture.paths.push_back({row.planner, row.single_path});
  for (const char* extension : {".png", ".svg"})
    draw_floor_plan(result.roadmap, {}, folder / (std::string("maze") + extension), picture);
}

int run(const Options& options, const Globals& globals) {
  if (!options.output.empty()) require_folder(options.output);
  MazeExperimentConfig config = options.config;
  config.maze.seed = config.seed;
  ProgressBar bar(globals);
  const MazeResult result = run_maze(config, bar.callback());
  bar.clear();
  const BenchTable table = table_of(result);
  const Json facts = {{"seed", config.seed},
                      {"voxel_size", config.voxel_size},
                      {"radius", config.min_clearance},
                      {"repeat", config.repeat},
                      {"vertices", result.roadmap.graph.vertices.size()},
                      {"edges", result.roadmap.graph.edges.size()}};
  if (!options.output.empty()) draw_paths(result, options.output);
  table.report(globals, options.output, "maze", facts);
  return kExitDone;
}

}  // namespace

void add_bench_maze(CLI::App& bench, const Globals& globals, Command& chosen) {
  const auto options = std::make_shared<Options>();
  MazeExperimentConfig& config = options->config;
  CLI::App* command =
      bench.add_subcommand("maze", "Every planner on one maze: success, time and length");
  command->add_option("--voxel-size", config.voxel_size, "Metres")->capture_default_str();
  command->add_option("--min-clearance", config.min_clearance, "And radius of the robot, metres")
      ->capture_default_str();
  command->add_option("--cells", config.maze.cells, "Of the maze, along each side")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->add_option("--pairs", config.pairs, "Random starts and goals")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--long-pairs", config.long_pairs, "Of them, for RRT* with all of its time")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command
      ->add_option("--repeat", config.repeat,
                   "Rounds of all planners but that one, for median times")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--time-limit", config.time_limit, "Of a planner that samples, seconds")
      ->capture_default_str();
  command->add_option("--range", config.range, "Longest motion of a tree, metres")
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "Folder for maze.json, maze.csv and a picture of the paths (PNG, SVG)");
  add_seed_option(*command, config.seed, "Of maze, starts, goals and samples");
  command->footer("Example:\n  ridgeway bench maze -o results");
  run_when_given(*command, options, globals, chosen, run);
}

}  // namespace ridgeway::cli
