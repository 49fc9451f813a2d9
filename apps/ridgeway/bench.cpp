// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "bench.hpp"

#include "commands.hpp"

namespace ridgeway::cli {

void add_bench_command(Command& program) {
  Command bench =
      program.add("bench", "Run an experiment: a table, and files and pictures with -o FOLDER");
  bench.require_command();
  add_bench_explore(bench);
  add_bench_fusion(bench);
  add_bench_grid(bench);
  add_bench_hall(bench);
  add_bench_live(bench);
  add_bench_maze(bench);
  add_bench_noise(bench);
  add_bench_trajectory(bench);
  bench.footer("Example:\n  ridgeway bench noise -o results");
}

}  // namespace ridgeway::cli
