// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "commands.hpp"

namespace ridgeway::cli {

/// Each adds an experiment to `bench`.
void add_bench_fusion(CLI::App& bench, const Globals& globals, Command& chosen);
void add_bench_grid(CLI::App& bench, const Globals& globals, Command& chosen);
void add_bench_hall(CLI::App& bench, const Globals& globals, Command& chosen);
void add_bench_maze(CLI::App& bench, const Globals& globals, Command& chosen);
void add_bench_noise(CLI::App& bench, const Globals& globals, Command& chosen);
void add_bench_trajectory(CLI::App& bench, const Globals& globals, Command& chosen);

}  // namespace ridgeway::cli
