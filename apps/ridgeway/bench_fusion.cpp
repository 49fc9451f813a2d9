// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <limits>
#include <memory>

#include "arguments.hpp"
#include "bench.hpp"
#include "bench_table.hpp"
#include "console.hpp"
#include "experiments/fusion_speed.hpp"
#include "interruption.hpp"
#include "threads.hpp"

namespace ridgeway::cli {
namespace {

struct BenchFusionOptions {
  ScanOptions scan;
  std::string output;
  FusionSpeedConfig config;
};

int run(const BenchFusionOptions& options, const Globals& globals) {
  FusionSpeedConfig config = options.config;
  config.poses = options.scan.poses(config.seed);
  const World world = options.scan.load();
  if (!options.output.empty()) require_folder(options.output);
  ProgressBar bar(globals);
  std::vector<FusionSpeed> ways;
  const bool complete = completes([&] { run_fusion_speed(world, config, bar.callback(), ways); });
  bar.clear();
  // Each of ours against the loop of its own kind.
  const auto baseline = [&](std::size_t i) {
    const std::size_t own = i % 2 == 0 ? 2 : 3;
    return own < ways.size() ? ways[own].milliseconds.median
                             : std::numeric_limits<double>::quiet_NaN();
  };
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
                                  {"threads", threads_to_use(globals)}};
  return table.report(globals, options.output, "fusion", facts, complete);
}

}  // namespace

void add_bench_fusion(Command& bench) {
  const auto options = std::make_shared<BenchFusionOptions>();
  Command command = bench.add(
      "fusion", "Time and error of fusing depth images, against plain loops on one thread");
  add_scan_options(command, options->scan);
  command.number("--voxel-size", options->config.voxel_size, kLengths, "Metres");
  command.number("--truncation", options->config.truncation, kLengths, "Metres");
  command.number("--sigma", options->config.sigma, kLengthsFromZero,
                 "Gaussian noise on every range, metres");
  command.path("-o,--output", options->output, "Folder for fusion.json and fusion.csv");
  command.seed(options->config.seed, "Of poses and noise");
  command.footer("Example:\n  ridgeway bench fusion --threads 2");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
