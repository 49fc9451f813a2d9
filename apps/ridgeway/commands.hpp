// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <memory>

namespace CLI {  // NOLINT(readability-identifier-naming): theirs
class App;
}

namespace ridgeway::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitBadInput = 1;
inline constexpr int kExitNoPlan = 2;

/// Options that every subcommand has.
struct Globals {
  bool json = false;   ///< stdout is exactly one JSON object
  bool quiet = false;  ///< neither notes nor warnings nor progress
  int threads = 0;     ///< 0: all of the machine's
};

/// What was asked for, run once the command line has been understood; returns the exit code.
using Command = std::function<int()>;

/// Lets a subcommand, when given, put run(options, globals) into `chosen`.
template <typename App, typename Options>
void run_when_given(App& command, const std::shared_ptr<Options>& options, const Globals& globals,
                    Command& chosen, int (*run)(const Options&, const Globals&)) {
  command.callback([options, &globals, &chosen, run] {
    chosen = [options, &globals, run] { return run(*options, globals); };
  });
}

/// Each adds a subcommand to `app` that, when given, puts itself into `chosen`.
void add_bench_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_build_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_plan_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_check_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_info_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_export_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_world_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_fuse_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_simulate_command(CLI::App& app, const Globals& globals, Command& chosen);
void add_trajectory_command(CLI::App& app, const Globals& globals, Command& chosen);

}  // namespace ridgeway::cli
