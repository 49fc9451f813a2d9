// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <filesystem>
#include <memory>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "experiments/noise.hpp"
#include "interruption.hpp"
#include "pictures/scatter.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;

struct BenchNoiseOptions {
  ScanOptions scan;
  std::string output;
  NoiseConfig config;
};

std::string source_text(const NoiseMap& map) {
  return map.sigma ? "scans, sigma " + text_of(*map.sigma) + " m" : "ground truth";
}

std::size_t graph_size(const NoiseMap& map) {
  const SparseGraph& graph = map.built.roadmap.graph;
  return graph.vertices.size() + graph.edges.size();
}

BenchTable table_of(const NoiseResult& result) {
  BenchTable table;
  for (const NoiseMap& map : result.maps) {
    const BuildReport& report = map.built.report;
    const SparseGraph& graph = map.built.roadmap.graph;
    Json sigma, milliseconds;
    if (map.sigma) {
      sigma = *map.sigma;
      milliseconds = map.scan_milliseconds;
    }
    table.add(
        {{"voxel_size", map.voxel_size},
         {"source", map.sigma ? "scans" : "truth"},
         {"sigma", sigma},
         {"diagram_voxels", report.diagram_voxels},
         {"vertices", graph.vertices.size()},
         {"edges", graph.edges.size()},
         {"components", report.graph_components},
         {"traversable_components", report.traversable_components},
         {"cycles", map.cycles},
         {"clean", map.check.is_clean()},
         {"success", result.pairs == 0 ? Json()
                                       : Json(static_cast<double>(map.solved) /
                                              static_cast<double>(result.pairs))},
         {"length_ratio", {{"median", map.length_ratio.median}, {"p95", map.length_ratio.p95}}},
         {"scan_milliseconds", milliseconds}});
  }
  return table;
}

/// The paper's figure: elements of diagram and graph against voxel size.
void draw_elements(const NoiseResult& result, const std::filesystem::path& out) {
  ScatterSeries diagram{"diagram (voxels)", {}}, graph{"graph (vertices + edges)", {}};
  for (const NoiseMap& map : result.maps) {
    diagram.points.emplace_back(map.voxel_size,
                                static_cast<double>(map.built.report.diagram_voxels));
    graph.points.emplace_back(map.voxel_size, static_cast<double>(graph_size(map)));
  }
  ScatterChart chart;
  chart.title = "Elements of diagram and graph of one house, by voxel size and noise";
  chart.x_label = "voxel size (m)";
  chart.y_label = "elements";
  chart.series = {diagram, graph};
  chart.log_y = true;
  draw_scatter(chart, out);
}

/// The paper's picture: every map with its graph.
void draw_maps(const NoiseResult& result, int columns, const std::filesystem::path& out) {
  std::vector<SheetMap> maps;
  for (const NoiseMap& map : result.maps)
    maps.push_back({&map.built.roadmap, text_of(map.voxel_size) + " m, " + source_text(map) + ": " +
                                            count_text(graph_size(map)) + " elements"});
  PictureConfig picture;
  picture.diagram = false;
  picture.width = 2000;
  draw_map_sheet(maps, columns, "One house, " + count_text(maps.size()) + " maps", out, picture);
}

int run(const BenchNoiseOptions& options, const Globals& globals) {
  NoiseConfig config = options.config;
  config.poses = options.scan.poses(config.seed);
  const World world = options.scan.load();
  if (!options.output.empty()) require_folder(options.output);
  ProgressBar bar(globals);
  NoiseResult result;
  const bool complete = completes([&] { run_noise(world, config, bar.callback(), result); });
  bar.clear();
  const BenchTable table = table_of(result);
  const Json facts = {{"world", world.name},
                      {"scans", options.scan.scans},
                      {"seed", config.seed},
                      {"pairs", result.pairs},
                      {"checked_queries", config.queries},
                      {"size_ratio", result.size_ratio}};
  if (complete && !options.output.empty()) {
    const std::filesystem::path folder = options.output;
    const int columns = static_cast<int>(1 + config.sigmas.size());
    for (const char* extension : {".png", ".svg"}) {
      draw_elements(result, folder / (std::string("noise_elements") + extension));
      draw_maps(result, columns, folder / (std::string("noise_maps") + extension));
    }
  }
  const int code = table.report(globals, options.output, "noise", facts, complete);
  if (!globals.json && complete) {
    print_row("pairs", count_text(result.pairs));
    print_row("largest graph", text_of(result.size_ratio, 2) + " times the smallest");
  }
  return code;
}

}  // namespace

void add_bench_noise(Command& bench) {
  const auto options = std::make_shared<BenchNoiseOptions>();
  NoiseConfig& config = options->config;
  Command command =
      bench.add("noise", "Does the graph depend on voxel size and noise? One world, twelve maps");
  add_scan_options(command, options->scan);
  command.numbers("--voxel-sizes", config.voxel_sizes, kLengths, "Metres");
  command.numbers("--sigmas", config.sigmas, kLengthsFromZero,
                  "Gaussian noise on every range, metres");
  command.number("--min-clearance", config.min_clearance, kLengths,
                 "And radius of the routes, metres");
  command.whole("--isolated", config.isolated_below, {0, 1'000'000'000},
                "Take clusters of fewer occupied voxels as free");
  command.whole("--pairs", config.pairs, {1, 1'000'000}, "Starts and goals, common to all maps");
  command.whole("--queries", config.queries, {0, 1'000'000}, "Of the check of each map");
  command.path("-o,--output", options->output,
               "Folder for noise.json, noise.csv and the pictures (PNG, SVG)");
  command.seed(config.seed, "Of poses, noise, starts and goals");
  command.footer("Example:\n  ridgeway bench noise -o results");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
