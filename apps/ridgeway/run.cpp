// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "run.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/version.hpp"
#include "threads.hpp"

namespace ridgeway::cli {
namespace {

constexpr int kMostThreads = 1024;

void add_commands(CommandLine& line) {
  Command program = line.root();
  Globals& globals = line.globals();
  program.flag("--json", globals.json,
               "Print one JSON object to stdout; with --help a description of every option");
  program.flag("--quiet", globals.quiet, "No notes, warnings and progress on stderr");
  program.whole("--threads", globals.threads, {0, kMostThreads},
                "Threads to use, 0 for all of the machine's");
  add_build_command(program);
  add_plan_command(program);
  add_trajectory_command(program);
  add_check_command(program);
  add_info_command(program);
  add_explore_command(program);
  add_export_command(program);
  add_view_command(program);
  add_world_command(program);
  add_simulate_command(program);
  add_fuse_command(program);
  add_live_command(program);
  add_bench_command(program);
  program.footer(
      "Exit codes: 0 done, 1 bad usage or input, 2 no plan, 130 interrupted (143 terminated).\n"
      "Example:\n"
      "  ridgeway build data/fr_079.bt -o office.ridge --min-clearance 0.3\n"
      "  ridgeway plan office.ridge --from 0,0,0.6 --to 10,0,0.6");
}

int fail(bool json, const std::string& text) {
  const std::string message = printable(text);
  std::fprintf(stderr, "ridgeway: error: %s\n", message.c_str());
  if (json) print_json({{"error", message}});
  return kExitBadInput;
}

/// Without its middle where it is long, as a line of a file may be that is no text.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 400, kEnd = 100;
  if (text.size() <= kMost) return text;
  return text.substr(0, kMost - kEnd) + " ... " + text.substr(text.size() - kEnd);
}

/// Of its parts, for what() ends at a NUL that bytes of a file may hold.
int fail(bool json, const InputError& error) {
  return fail(json, shortened(error.where()) + ": " + shortened(error.problem()) + " (" +
                        shortened(error.remedy()) + ")");
}

/// Nothing was printed yet, so that with --json there is one object all the same.
int report_interrupted(const Globals& globals) {
  if (!globals.quiet) std::fprintf(stderr, "ridgeway: interrupted\n");
  if (globals.json) print_json({{"error", "interrupted"}});
  return interrupted_exit_code();
}

int run(const CommandLine& line, const Job& job) {
  const Globals& globals = line.globals();
  try {
    int code = with_threads(threads_to_use(globals), job);
    if (is_interrupted()) code = interrupted_exit_code();  // too late to be cancelled
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return fail(false, "stdout: the result cannot be written (check the disk or the pipe)");
    return code;
  } catch (const Cancelled&) {
    return report_interrupted(globals);
  } catch (const InputError& error) {
    if (is_interrupted()) return report_interrupted(globals);
    return fail(globals.json, line.with_options(error));
  } catch (const std::bad_alloc&) {
    const std::string& subject = line.subject();
    return fail(globals.json,
                {subject.empty() ? "memory" : subject, "needs more memory than there is",
                 "close other programs, or use a machine with more"});
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(globals.json, error.path1().string() + ": " + error.code().message() +
                                  " (check the path and who may use it)");
  } catch (const std::exception& error) {
    return fail(globals.json, std::string("unexpected: ") + error.what());
  }
}

/// "help" and "help COMMAND" ask for what --help does.
std::vector<std::string> asked(std::vector<std::string> words) {
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

}  // namespace

int run(int argc, const char* const* argv) {
  CommandLine line("ridgeway", "Turns 3D voxel maps into a sparse planning graph, and plans on it",
                   kVersion);
  add_commands(line);
  const bool json = std::any_of(argv + 1, argv + argc, [](const std::string& word) {
    return word == "--json" || word == "--json=true";
  });
  Job job;
  try {
    job = line.parse(asked(join_values(argc, argv)));
  } catch (const InputError& error) {
    return fail(json, error);
  }
  return run(line, job);
}

}  // namespace ridgeway::cli
