// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/version.hpp"

namespace ridgeway::cli {
namespace {

constexpr int kMostThreads = 1024;

void add_commands(CLI::App& app, Globals& globals, Command& chosen) {
  app.set_version_flag("--version", std::string("ridgeway ") + kVersion);
  app.add_flag("--json", globals.json, "Print one JSON object to stdout");
  app.add_flag("--quiet", globals.quiet, "No notes, warnings and progress on stderr");
  app.add_option("--threads", globals.threads, "Threads to use, 0 for all of the machine's")
      ->check(CLI::Range(0, kMostThreads));
  app.require_subcommand(0, 1);
  app.fallthrough();
  add_build_command(app, globals, chosen);
  add_plan_command(app, globals, chosen);
  add_trajectory_command(app, globals, chosen);
  add_check_command(app, globals, chosen);
  add_info_command(app, globals, chosen);
  add_export_command(app, globals, chosen);
  add_world_command(app, globals, chosen);
  add_simulate_command(app, globals, chosen);
  add_fuse_command(app, globals, chosen);
  add_bench_command(app, globals, chosen);
  for (CLI::App* command : app.get_subcommands({}))
    command->footer("Every command has --json, --quiet and --threads N: see ridgeway --help.\n" +
                    command->get_footer());
  app.footer(
      "Exit codes: 0 done, 1 bad usage or input, 2 no plan.\n"
      "Example:\n"
      "  ridgeway build data/fr_079.bt -o office.ridge --min-clearance 0.3\n"
      "  ridgeway plan office.ridge --from 0,0,0.6 --to 10,0,0.6");
}

int fail(bool json, const std::string& message) {
  std::fprintf(stderr, "ridgeway: error: %s\n", message.c_str());
  if (json) print_json({{"error", message}});
  return kExitBadInput;
}

/// Where to read on after a mistake on the command line.
std::string help_command(const CLI::App& app) {
  const std::vector<CLI::App*> used = app.get_subcommands();
  return used.empty() ? "ridgeway --help" : "ridgeway " + used.front()->get_name() + " --help";
}

int run(std::vector<std::string> words) {
  CLI::App app("Turns 3D voxel maps into a sparse planning graph, and plans on it", "ridgeway");
  Globals globals;
  Command chosen;
  add_commands(app, globals, chosen);
  const bool json = std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "--json" || word == "--json=true";
  });
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    return fail(json, std::string(error.what()) + " (see " + help_command(app) + ")");
  }
  if (!chosen) return fail(json, "no command was given (see ridgeway --help)");
  try {
    const int code = with_threads(globals.threads, chosen);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return fail(false, "stdout: the result cannot be written (check the disk or the pipe)");
    return code;
  } catch (const InputError& error) {
    return fail(globals.json, error.what());
  } catch (const std::bad_alloc&) {
    return fail(globals.json,
                "memory: there is not enough (give a larger --voxel-size or smaller --bounds)");
  } catch (const std::exception& error) {
    return fail(globals.json, std::string("unexpected: ") + error.what());
  }
}

}  // namespace
}  // namespace ridgeway::cli

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is then an error of its writer
  return ridgeway::cli::run(ridgeway::cli::join_negative_values(argc, argv));
}
