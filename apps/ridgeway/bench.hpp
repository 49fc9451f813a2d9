// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "command.hpp"

namespace ridgeway::cli {

/// Each adds an experiment to `bench`.
void add_bench_explore(Command& bench);
void add_bench_fusion(Command& bench);
void add_bench_grid(Command& bench);
void add_bench_hall(Command& bench);
void add_bench_live(Command& bench);
void add_bench_maze(Command& bench);
void add_bench_noise(Command& bench);
void add_bench_trajectory(Command& bench);

}  // namespace ridgeway::cli
