// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "bench.hpp"
#include "bench_table.hpp"
#include "common/number_text.hpp"
#include "console.hpp"
#include "experiments/grid.hpp"
#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "formats/benchmark_map.hpp"
#include "formats/benchmark_scenarios.hpp"
#include "interruption.hpp"
#include "pictures/scatter.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;
namespace fs = std::filesystem;

constexpr double kVoxelSize = 1.0;  // the stored lengths count cells
constexpr std::size_t kSeriesPerChart = 8;
constexpr int kPointsPerDecade = 12;  // of a chart's curve
constexpr double kMostExcess = 50.0;  // per cent; the few beyond would squeeze all others

struct BenchGridOptions {
  std::vector<std::string> maps;
  std::string output;
  GridExperimentConfig config;
};

/// A map's file as it was read, and its queries.
struct Source {
  fs::path file;
  std::string bytes;
  std::vector<GridScenario> scenarios;
};

fs::path scenario_file(const fs::path& map) {
  fs::path appended = map, replaced = map;
  appended += ".3dscen";
  replaced.replace_extension(".3dscen");
  for (const fs::path& file : {appended, replaced})
    if (std::error_code error; fs::exists(file, error)) return file;
  throw InputError(
      map.string(), "has no scenarios beside it",
      "put " + appended.filename().string() + " or " + replaced.filename().string() + " there");
}

Source read_source(const fs::path& map, const Globals& globals) {
  Source source{map, read_file(map), {}};
  if (!is_benchmark_map(source.bytes))
    throw InputError(map.string(), "is not a map of the MovingAI 3D benchmarks",
                     "give a .3dmap file, whose first line is \"voxel X Y Z\"");
  const fs::path file = scenario_file(map);
  const BenchmarkScenarios read = read_benchmark_scenarios(read_file(file), file.string());
  if (read.map != map.filename()) warn(globals, file.string() + " says that it is for " + read.map);
  if (read.scenarios.empty())
    throw InputError(file.string(), "holds no scenarios", "give a whole .3dscen file");
  for (const BenchmarkScenario& scenario : read.scenarios)
    source.scenarios.push_back({centre_of(scenario.start, kVoxelSize),
                                centre_of(scenario.goal, kVoxelSize), scenario.optimal_length});
  return source;
}

/// Place in the benchmark of the longest path over its optimum.
Json longest_scenario(const GridRow& row) {
  const std::vector<double>& ratios = row.shortened.ratios;
  const auto found = std::find(ratios.begin(), ratios.end(), row.shortened.length_over_optimum.max);
  if (found == ratios.end()) return {};
  return row.scenarios[static_cast<std::size_t>(found - ratios.begin())];
}

Json json_of(const GridRow& row) {
  const GridAnswers& graph = row.shortened;
  const auto count = static_cast<double>(row.scenarios.size());
  return {{"map", row.map},
          {"scenarios", row.scenarios.size()},
          {"solvable", row.solvable},
          {"solved", graph.solved},
          {"success", static_cast<double>(graph.solved) / count},
          {"fallbacks", graph.fallbacks},
          {"length_over_optimum", cli::json_of(graph.length_over_optimum)},
          {"longest_scenario", longest_scenario(row)},
          {"within_violations", graph.within_violations},
          {"microseconds", cli::json_of(graph.microseconds)},
          {"raw",
           {{"solved", row.raw.solved},
            {"length_over_optimum", cli::json_of(row.raw.length_over_optimum)},
            {"microseconds", cli::json_of(row.raw.microseconds)}}},
          {"optimum_checked", row.optimum_checked},
          {"optimum_reproduced", row.optimum_reproduced},
          {"build_seconds", row.build_seconds},
          {"vertices", row.vertices},
          {"edges", row.edges}};
}

/// What share of a map's scenarios is at least so much longer than the optimum: a few points of
/// each power of ten.
ScatterSeries excess_series(const GridRow& row) {
  std::vector<double> excess;  // per cent, longest first
  for (const double ratio : row.shortened.ratios)
    if (!std::isnan(ratio)) excess.push_back(100.0 * (ratio - 1.0));
  std::sort(excess.rbegin(), excess.rend());
  ScatterSeries series{row.map, {}, SeriesStyle::kLine};
  std::size_t last = 0;
  for (double at = 1.0; last < excess.size(); at *= std::pow(10.0, 1.0 / kPointsPerDecade)) {
    const std::size_t place = std::min(static_cast<std::size_t>(std::round(at)), excess.size());
    if (place == last) continue;
    last = place;
    if (excess[place - 1] > kMostExcess) continue;
    series.points.emplace_back(excess[place - 1],
                               static_cast<double>(place) / static_cast<double>(excess.size()));
  }
  return series;
}

void draw_excess(const std::vector<GridRow>& rows, const fs::path& folder) {
  std::vector<ScatterSeries> all;
  for (const GridRow& row : rows)
    if (ScatterSeries series = excess_series(row); !series.points.empty())
      all.push_back(std::move(series));
  for (std::size_t first = 0; first < all.size(); first += kSeriesPerChart) {
    ScatterChart chart;
    chart.title = "How much longer than the stored optimum?";
    chart.x_label = "longer than the optimum over the voxels (%), up to " + text_of(kMostExcess);
    chart.y_label = "share of the scenarios that is at least so much longer";
    const std::size_t last = std::min(first + kSeriesPerChart, all.size());
    for (std::size_t i = first; i < last; ++i) chart.series.push_back(all[i]);
    chart.log_y = true;
    const std::string name =
        first == 0 ? "grid" : "grid_" + std::to_string(1 + first / kSeriesPerChart);
    for (const char* extension : {".png", ".svg"}) draw_scatter(chart, folder / (name + extension));
  }
}

/// A line for each scenario, to look for what is long.
std::string scenarios_csv(const std::vector<GridRow>& rows, const std::vector<Source>& sources) {
  std::string csv = "map,scenario,optimum,length_over_optimum,raw.length_over_optimum\n";
  for (std::size_t map = 0; map < rows.size(); ++map)
    for (std::size_t i = 0; i < rows[map].scenarios.size(); ++i) {
      const GridRow& row = rows[map];
      csv.append(csv_cell(row.map)).append(",").append(number_text(row.scenarios[i]));
      for (const double value : {sources[map].scenarios[row.scenarios[i]].optimum,
                                 row.shortened.ratios[i], row.raw.ratios[i]})
        csv.append(",").append(std::isnan(value) ? "" : number_text(value));
      csv.append("\n");
    }
  return csv;
}

int run(const BenchGridOptions& options, const Globals& globals) {
  options.config.validate();
  std::vector<std::string> names;
  names.reserve(options.maps.size());
  for (const fs::path map : options.maps) names.push_back(map.stem().string());
  require_distinct(std::move(names));
  std::vector<Source> sources;  // all of them before the long work
  for (const std::string& map : options.maps) sources.push_back(read_source(map, globals));
  if (!options.output.empty()) require_folder(options.output);
  ProgressBar bar(globals);
  BenchTable table;
  std::vector<GridRow> rows;
  const bool complete = completes([&] {
    for (const Source& source : sources) {
      const std::string name = source.file.string();
      rows.push_back(
          run_grid({source.file.stem().string(), read_benchmark_map(source.bytes, name, kVoxelSize),
                    source.scenarios},
                   options.config, bar.callback()));
      table.add(json_of(rows.back()));
    }
  });
  bar.clear();
  if (complete && !options.output.empty()) {
    draw_excess(rows, options.output);
    write_text_file(fs::path(options.output) / "grid_scenarios.csv", scenarios_csv(rows, sources));
  }
  return table.report(globals, options.output, "grid",
                      {{"voxel_size", kVoxelSize}, {"radius", options.config.min_clearance}},
                      complete);
}

}  // namespace

void add_bench_grid(Command& bench) {
  const auto options = std::make_shared<BenchGridOptions>();
  GridExperimentConfig& config = options->config;
  Command command = bench.add(
      "grid", "The MovingAI 3D benchmarks: success, time, and length over the stored optimum");
  command
      .paths("maps", options->maps,
             ".3dmap files, each with its scenarios (MAP.3dmap.3dscen or MAP.3dscen) beside")
      .required();
  command.whole("--scenarios", config.scenarios, {0, 100'000'000},
                "At most so many of each map's, evenly spread (0: all)");
  command.whole("--exact", config.exact, {0, 100'000'000},
                "The first of them, that A* through the distance field shall reproduce");
  command.path("-o,--output", options->output,
               "Folder for grid.json, grid.csv, grid_scenarios.csv and a chart (PNG, SVG)");
  command.footer("Example:\n  ridgeway bench grid data/warframe/Simple.3dmap -o results");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
