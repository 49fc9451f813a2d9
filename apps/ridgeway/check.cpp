// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/check.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "files/atomic_file.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "limit_options.hpp"
#include "quality_option.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/ridge/ridge_file.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostQueries = 1000000;  // their paths are all kept

struct CheckOptions {
  std::string file, paths;
  QualityOption quality;
  CheckConfig check{.queries = 200};
  LimitOptions limits;
};

Json json_of(const CheckReport& report, bool complete) {
  return {{"complete", complete},
          {"edges", report.edges},
          {"edges_below_clearance", report.edges_below_clearance},
          {"components", report.components},
          {"queries", report.queries},
          {"graph_ok", report.graph_ok},
          {"esdf_ok", report.esdf_ok},
          {"disagreements", report.disagreements},
          {"paths_below_clearance", report.paths_below_clearance},
          {"length_ratio", cli::json_of(report.length_ratio)},
          {"microseconds", cli::json_of(report.microseconds)},
          {"raw_microseconds", cli::json_of(report.raw_microseconds)},
          {"esdf_milliseconds", cli::json_of(report.esdf_milliseconds)},
          {"fallbacks", report.fallbacks},
          {"clean", complete && report.is_clean()}};
}

Json paths_json(const CheckReport& report) {
  Json paths = Json::array();
  for (const CheckedPath& path : report.paths) {
    Json waypoints = Json::array();
    for (const Point& p : path.waypoints) waypoints.push_back(cli::json_of(p));
    paths.push_back({{"radius", path.radius}, {"waypoints", std::move(waypoints)}});
  }
  return paths;
}

std::string spread_text(const Spread& spread, int decimals, const std::string& unit) {
  return "median " + text_of(spread.median, decimals) + unit + ", p95 " +
         text_of(spread.p95, decimals) + unit + ", p99 " + text_of(spread.p99, decimals) + unit +
         ", max " + text_of(spread.max, decimals) + unit;
}

void print_summary(const CheckReport& report, bool complete) {
  print_row("edges", count_text(report.edges) + ", " + count_text(report.edges_below_clearance) +
                         " below the clearance");
  print_row("components", count_text(report.components));
  print_row("queries", count_text(report.queries) + ": solved by the roadmap " +
                           count_text(report.graph_ok) + ", by A* in the ESDF " +
                           count_text(report.esdf_ok) + ", disagreements " +
                           count_text(report.disagreements));
  if (report.queries > 0) {
    print_row("paths", count_text(report.paths_below_clearance) + " below the clearance, " +
                           count_text(report.fallbacks) + " answered beyond the graph");
    print_row("length ratio", spread_text(report.length_ratio, 3, ""));
    print_row("query time", spread_text(report.microseconds, 0, " us"));
    print_row("unshortened", spread_text(report.raw_microseconds, 0, " us"));
    print_row("ESDF A*", spread_text(report.esdf_milliseconds, 2, " ms"));
  }
  print_row("result", report.is_clean() && !complete ? "interrupted: clean so far"
                      : report.is_clean()            ? "clean"
                                          : "NOT clean: the roadmap breaks its contract");
}

/// A path that somebody wants to have checked is not written over.
void require_list_of_paths_or_nothing(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return;
  if (const int first = std::ifstream(file).get(); first == '[' || first == EOF) return;
  throw InputError(file, "is there already, and is no list of checked paths",
                   "give --paths, which is written, another name");
}

int run(const CheckOptions& options, const Globals& globals) {
  if (!options.paths.empty()) require_writable({options.paths}, {options.file});
  if (!options.paths.empty()) require_extension(options.paths, "paths", {".json"});
  if (!options.paths.empty()) require_list_of_paths_or_nothing(options.paths);
  CheckConfig config = options.check;
  config.limits = limits_of(options.limits);
  config.quick = options.quality.quick();
  config.within = options.quality.within();
  const Roadmap roadmap = load_roadmap(options.file);
  ProgressBar bar(globals);
  CheckReport report;
  const bool complete = completes([&] { check_roadmap(roadmap, config, bar.callback(), report); });
  bar.clear();
  if (!options.paths.empty()) write_text_file(options.paths, paths_json(report).dump() + "\n");
  if (globals.json)
    print_json(json_of(report, complete));
  else
    print_summary(report, complete);
  if (!complete) return interrupted_exit_code();
  return report.is_clean() ? kExitDone : kExitBadInput;
}

}  // namespace

void add_check_command(Command& program) {
  const auto options = std::make_shared<CheckOptions>();
  Command command =
      program.add("check", "Verify the contract of a roadmap against the distances it holds");
  command.path("roadmap", options->file, "Roadmap, .ridge").required();
  command.whole("--queries", options->check.queries, {0, kMostQueries},
                "Random queries to compare with A*");
  command.seed(options->check.seed, "Of the random queries");
  add_limit_options(command, options->limits);
  command.number("--robot-height", options->check.robot_height, kLengthsFromZero,
                 "Metres: the robot is an upright cylinder of this height; 0: it is a sphere");
  add_quality_option(command, options->quality, "Of the roadmap's answers, as in `ridgeway plan`");
  command.path("--paths", options->paths,
               "File to write the checked paths to, .json, for other checkers");
  command.footer(
      "Exit code 1 when something is not as it must be.\n"
      "Example:\n"
      "  ridgeway check office.ridge --queries 1000 --seed 1");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
