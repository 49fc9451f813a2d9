// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bench.hpp"

#include <CLI/CLI.hpp>

#include "commands.hpp"

namespace ridgeway::cli {

void add_bench_command(CLI::App& app, const Globals& globals, Command& chosen) {
  CLI::App* bench =
      app.add_subcommand("bench", "Run an experiment: a table, and pictures with -o FOLDER");
  bench->require_subcommand(1);
  bench->fallthrough();
  add_bench_fusion(*bench, globals, chosen);
  add_bench_grid(*bench, globals, chosen);
  add_bench_hall(*bench, globals, chosen);
  add_bench_maze(*bench, globals, chosen);
  add_bench_noise(*bench, globals, chosen);
  add_bench_trajectory(*bench, globals, chosen);
  bench->footer("Example:\n  ridgeway bench noise -o results");
}

}  // namespace ridgeway::cli
