// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <CLI/CLI.hpp>
#include <memory>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "ridgeway/experiments/fusion_speed.hpp"

namespace ridgeway::cli {
namespace {

struct Options {
  ScanOptions scan;
  std::string output;
  FusionSpeedConfig config;
};

int run(const Options& options, const Globals& globals) {
  FusionSpeedConfig config = options.config;
  config.poses = options.scan.poses(config.seed);
  const World world = options.scan.load();
  if (!options.output.empty()) require_folder(options.output);
  ProgressBar bar(globals);
  const std::vector<FusionSpeed> ways = run_fusion_speed(world, config, bar.callback());
  bar.clear();
  // Each of ours against the loop of its own kind.
  const auto baseline = [&](std::size_t i) { return ways[i % 2 == 0 ? 2 : 3].milliseconds.median; };
  BenchTable table;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const FusionSpeed& way = ways[i];
    table.add(
        {{"integrator", way.integrator},
         {"milliseconds", {{"median", way.milliseconds.median}, {"p95", way.milliseconds.p95}}},
         {"times_as_fast", baseline(i) / way.milliseconds.median},
         {"voxels", way.voxels},
         {"error_voxels",
          {{"mean", way.mean_error}, {"p95", way.error.p95}, {"p99", way.error.p99}}}});
  }
  const BenchTable::Json facts = {{"world", world.name},
                                  {"scans", options.scan.scans},
                                  {"voxel_size", config.voxel_size},
                                  {"sigma", config.sigma},
                                  {"threads", globals.threads}};
  table.report(globals, options.output, "fusion", facts);
  return kExitDone;
}

}  // namespace

void add_bench_fusion(CLI::App& bench, const Globals& globals, Command& chosen) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "fusion", "Time and error of fusing depth images, against plain loops on one thread");
  add_scan_options(*command, options->scan);
  command->add_option("--voxel-size", options->config.voxel_size, "Metres")->capture_default_str();
  command->add_option("--truncation", options->config.truncation, "Metres")->capture_default_str();
  command->add_option("--sigma", options->config.sigma, "Gaussian noise on every range, metres")
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "Folder for fusion.json and fusion.csv");
  add_seed_option(*command, options->config.seed, "Of poses and noise");
  command->footer("Example:\n  ridgeway bench fusion --threads 2");
  run_when_given(*command, options, globals, chosen, run);
}

}  // namespace ridgeway::cli
