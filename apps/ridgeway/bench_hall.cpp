// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <system_error>
#include <thread>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "common/number_text.hpp"
#include "console.hpp"
#include "experiments/hall.hpp"
#include "experiments/tunnels.hpp"
#include "files/temporary.hpp"
#include "interruption.hpp"
#include "pictures/scatter.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

namespace ridgeway::cli {
namespace {

using Json = BenchTable::Json;
namespace fs = std::filesystem;

constexpr const char* kHall = "hall";  // as run_hall names it

struct BenchHallOptions {
  std::vector<std::string> maps;
  std::string output;
  std::vector<double> tunnels;  // kilometres
  HallExperimentConfig config;
};

/// A mine of so many kilometres, at 0.1 m.
HallMap tunnels_of(double kilometres, std::uint64_t seed) {
  const TunnelConfig config{.length = 1000.0 * kilometres, .seed = seed};
  return {"tunnels of " + number_text(kilometres) + " km",
          [config] { return make_tunnels(config); }};
}

/// One number for each stage, by the member of StageNumbers that holds it.
template <typename Number>
Json json_of_stages(const Number& number) {
  Json json = Json::object();
  for (const StageName& stage : kStageNames) json[stage.name] = number(stage.number);
  return json;
}

/// A row, beside that of the same map with the first number of threads.
Json json_of(const HallRow& row, const HallRow& first) {
  const auto known = static_cast<double>(row.counts.voxels.known());
  const auto seconds = [&](auto stage) { return row.seconds.*stage; };
  const auto rate = [&](auto stage) { return std::round(row.voxels.*stage / row.seconds.*stage); };
  const auto bytes = [&](auto stage) { return std::round(row.bytes.*stage); };
  Json peak, peak_per_voxel;
  if (row.peak_memory) {
    peak = *row.peak_memory;
    peak_per_voxel = static_cast<double>(*row.peak_memory) / known;
  }
  return {{"map", row.map},
          {"voxel_size", row.voxel_size},
          {"min_clearance", row.min_clearance},
          {"threads", row.threads},
          {"known_voxels", row.counts.voxels.known()},
          {"allocated_voxels", row.counts.allocated_voxels},
          {"traversable_voxels", row.counts.traversable_voxels},
          {"diagram_voxels", row.counts.diagram_voxels},
          {"vertices", row.vertices},
          {"edges", row.edges},
          {"seconds", json_of_stages(seconds)},
          {"nanoseconds_per_known_voxel", 1e9 * row.seconds.total / known},
          {"voxels_per_second", json_of_stages(rate)},
          {"bytes", json_of_stages(bytes)},
          {"bandwidth",
           {{"copy", std::round(row.copy_bandwidth)},
            {"esdf_fraction", row.bandwidth_fraction(&StageNumbers::esdf)},
            {"gvd_fraction", row.bandwidth_fraction(&StageNumbers::gvd)}}},
          {"peak_memory_bytes", peak},
          {"peak_bytes_per_known_voxel", peak_per_voxel},
          {"first_answer",
           {{"load", row.load_seconds},
            {"query", row.first_query_seconds},
            {"total", row.first_answer_seconds}}},
          {"batch", {{"solved", row.solved}, {"seconds", row.batch_seconds}}},
          {"times_as_fast",
           {{"esdf", first.seconds.esdf / row.seconds.esdf},
            {"esdf_to_graph", first.seconds.esdf_to_graph / row.seconds.esdf_to_graph},
            {"total", first.seconds.total / row.seconds.total},
            {"batch", first.batch_seconds / row.batch_seconds}}}};
}

BenchTable table_of(const std::vector<HallRow>& rows, std::size_t rows_a_map) {
  BenchTable table;
  for (std::size_t i = 0; i < rows.size(); ++i)
    table.add(json_of(rows[i], rows[i - i % rows_a_map]));
  return table;
}

std::string threads_text(int threads) {
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

/// The line through the finest hall, along which time grows as voxels do.
ScatterSeries linear_growth(const std::vector<HallRow>& rows) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0, finest = 0.0, seconds = 0.0;
  for (const HallRow& row : rows) {
    const auto known = static_cast<double>(row.counts.voxels.known());
    least = std::min(least, known);
    most = std::max(most, known);
    if (row.map == kHall && known > finest) {
      finest = known;
      seconds = row.seconds.total;
    }
  }
  return {"linear growth",
          {{least, seconds * least / finest}, {most, seconds * most / finest}},
          SeriesStyle::kGuide};
}

/// The paper's question as a figure: does the time grow with the map alone?
void draw_times(const std::vector<HallRow>& rows, const fs::path& out) {
  constexpr std::size_t kMostThreads = 3;  // of which there is room for lines
  std::map<int, ScatterSeries> total, graph;
  ScatterSeries others{"other maps, all", {}};
  for (const HallRow& row : rows) {
    const auto known = static_cast<double>(row.counts.voxels.known());
    if (row.map != kHall) {
      others.points.emplace_back(known, row.seconds.total);
      continue;
    }
    const auto series = [&](auto& all, const char* what) -> ScatterSeries& {
      const std::string name = std::string("hall, ") + what + ", " + threads_text(row.threads);
      return all.try_emplace(row.threads, ScatterSeries{name, {}, SeriesStyle::kLine})
          .first->second;
    };
    series(total, "all").points.emplace_back(known, row.seconds.total);
    series(graph, "field to graph").points.emplace_back(known, row.seconds.esdf_to_graph);
  }
  ScatterChart chart;
  chart.title = "Time grows with the known voxels";
  chart.x_label = "known voxels";
  chart.y_label = "seconds";
  chart.log_x = chart.log_y = true;
  for (const auto* all : {&total, &graph})
    for (const auto& [threads, series] : *all)
      if (chart.series.size() < 2 * kMostThreads) chart.series.push_back(series);
  if (!others.points.empty()) chart.series.push_back(others);
  chart.series.push_back(linear_growth(rows));
  draw_scatter(chart, out);
}

int run(const BenchHallOptions& options, const Globals& globals) {
  HallExperimentConfig config = options.config;
  config.hall.seed = config.seed;
  if (!options.output.empty()) require_folder(options.output);
  std::vector<HallMap> maps;
  for (const std::string& file : options.maps) {
    const fs::path path = file;
    const fs::path name = path.stem() == kHall ? path.filename() : path.stem();
    maps.push_back({name.string(), [file] { return load_map(file); }});
  }
  for (const double kilometres : options.tunnels)
    maps.push_back(tunnels_of(kilometres, config.seed));
  const fs::path place =
      options.output.empty() ? fs::temp_directory_path() : fs::path(options.output);
  const Temporary folder(place / kHall, Temporary::Kind::kFolder);
  if (folder.error() != 0)
    throw InputError(place.string(), "cannot be written to", "give another folder with -o");
  const fs::path file = folder.path() / "hall.ridge";
  const RoadmapStore store{[&](const Roadmap& roadmap) { save_roadmap(roadmap, file); },
                           [&] { return load_roadmap(file); }};
  ProgressBar bar(globals);
  std::vector<HallRow> rows;
  const bool complete = completes([&] { run_hall(config, maps, store, bar.callback(), rows); });
  bar.clear();
  const BenchTable table = table_of(rows, config.threads.size());
  const Json facts = {{"seed", config.seed},
                      {"repeat", config.repeat},
                      {"queries", config.queries},
                      {"machine_threads", std::thread::hardware_concurrency()}};
  if (complete && !options.output.empty())
    for (const char* extension : {".png", ".svg"})
      draw_times(rows, fs::path(options.output) / (std::string("hall_times") + extension));
  return table.report(globals, options.output, "hall", facts, complete);
}

}  // namespace

void add_bench_hall(Command& bench) {
  const auto options = std::make_shared<BenchHallOptions>();
  HallExperimentConfig& config = options->config;
  Command command = bench.add(
      "hall", "How long does a map take? Each stage, memory and first answer, by voxel size");
  command.paths("maps", options->maps, "Maps to build beside the hall, as build takes them");
  command.numbers("--voxel-sizes", config.voxel_sizes, kLengths, "Of the hall, metres");
  command.numbers("--tunnels", options->tunnels, {.least = 1e-3, .most = 1000.0},
                  "Kilometres of seeded mines to build beside the hall, at 0.1 m");
  command.wholes("--threads-list", config.threads, {1, 1024},
                 "Numbers of threads; the first is what the others are compared with");
  command.whole("--repeat", config.repeat, {1, 10'000}, "Builds of which medians are taken");
  command.number("--min-clearance", config.min_clearance, kLengths,
                 "Metres; at least two voxels are taken");
  command.whole("--queries", config.queries, {1, 1'000'000}, "Of the batch that runs in parallel");
  command.path("-o,--output", options->output,
               "Folder for hall.json, hall.csv and the figure (PNG, SVG)");
  command.seed(config.seed, "Of hall, mines, starts and goals");
  command.footer("Example:\n  ridgeway bench hall data/fr_079.bt -o results");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
