// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "command.hpp"

namespace ridgeway::cli {

/// Each adds a command.
void add_bench_command(Command& program);
void add_build_command(Command& program);
void add_plan_command(Command& program);
void add_check_command(Command& program);
void add_info_command(Command& program);
void add_explore_command(Command& program);
void add_export_command(Command& program);
void add_world_command(Command& program);
void add_fuse_command(Command& program);
void add_live_command(Command& program);
void add_simulate_command(Command& program);
void add_trajectory_command(Command& program);
void add_view_command(Command& program);

}  // namespace ridgeway::cli
