// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <filesystem>
#include <memory>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "experiments/maze.hpp"
#include "interruption.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;

struct BenchMazeOptions {
  std::string output;
  MazeExperimentConfig config;
};

BenchTable table_of(const MazeResult& result) {
  BenchTable table;
  if (result.rows.empty()) return table;
  const double ours = result.rows.back().seconds.median;
  for (const MazeRow& row : result.rows) {
    const auto if_solved = [&](double value) { return row.solved > 0 ? Json(value) : Json(); };
    table.add({{"planner", row.planner},
               {"queries", row.queries},
               {"solved", row.solved},
               {"seconds",
                {{"median", if_solved(row.seconds.median)}, {"p95", if_solved(row.seconds.p95)}}},
               {"seconds_over_graph", ours > 0.0 ? if_solved(row.seconds.median / ours) : Json()},
               {"length", {{"median", if_solved(row.length.median)}}},
               {"length_over_esdf",
                {{"median", if_solved(row.length_over_esdf.median)},
                 {"p95", if_solved(row.length_over_esdf.p95)}}},
               {"vertices", {{"median", if_solved(row.vertices.median)}}},
               {"single",
                {{"seconds", row.single_seconds},
                 {"length", row.single_length},
                 {"vertices", row.single_vertices}}}});
  }
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

int run(const BenchMazeOptions& options, const Globals& globals) {
  if (!options.output.empty()) require_folder(options.output);
  MazeExperimentConfig config = options.config;
  config.maze.seed = config.seed;
  ProgressBar bar(globals);
  MazeResult result;
  const bool complete = completes([&] { run_maze(config, bar.callback(), result); });
  bar.clear();
  const BenchTable table = table_of(result);
  const Json facts = {{"seed", config.seed},
                      {"voxel_size", config.voxel_size},
                      {"explored", config.explored},
                      {"radius", config.min_clearance},
                      {"repeat", config.repeat},
                      {"vertices", result.roadmap.graph.vertices.size()},
                      {"edges", result.roadmap.graph.edges.size()}};
  if (complete && !options.output.empty()) draw_paths(result, options.output);
  return table.report(globals, options.output, "maze", facts, complete);
}

}  // namespace

void add_bench_maze(Command& bench) {
  const auto options = std::make_shared<BenchMazeOptions>();
  MazeExperimentConfig& config = options->config;
  Command command = bench.add("maze", "Every planner on one maze: success, time and length");
  command.number("--voxel-size", config.voxel_size, kLengths, "Metres");
  command.number("--min-clearance", config.min_clearance, kLengths,
                 "And radius of the robot, metres");
  command.whole("--cells", config.maze.cells, {2, 1000}, "Of the maze, along each side");
  command.whole("--pairs", config.pairs, {1, 100'000}, "Random starts and goals");
  command.whole("--long-pairs", config.long_pairs, {0, 100'000},
                "Of them, for RRT* with all of its time");
  command.whole("--repeat", config.repeat, {1, 10'000},
                "Rounds of all planners but that one, for median times");
  command.number("--time-limit", config.time_limit, {.least = 0.0, .most = 1e9, .above = true},
                 "Of a planner that samples, seconds");
  command.number("--range", config.range, kLengths, "Longest motion of a tree, metres");
  command.flag("--explored", config.explored,
               "On the map of a drone that explored the maze, not on the ground truth");
  command.path("-o,--output", options->output,
               "Folder for maze.json, maze.csv and a picture of the paths (PNG, SVG)");
  command.seed(config.seed, "Of maze, starts, goals and samples");
  command.footer("Example:\n  ridgeway bench maze -o results");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
