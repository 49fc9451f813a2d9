// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/plan.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "query_file.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/io/path_io.hpp"
#include "ridgeway/io/ridge_file.hpp"
#include "roadmap_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file, from, to, planner = "graph", output, queries;
  std::optional<double> radius;
  double time_limit = std::numeric_limits<double>::infinity();
  bool raw = false;
  int repeat = 1;
};

PlanConfig plan_config(const Options& options) {
  PlanConfig config;
  for (const Planner planner : {Planner::kGraph, Planner::kDiagram, Planner::kEsdf})
    if (options.planner == name_of(planner)) config.planner = planner;
  config.radius = options.radius;
  config.shorten = !options.raw;
  config.time_limit = options.time_limit;
  config.validate();
  return config;
}

/// Plans `repeat` times; the times are then medians.
PlanResult plan_repeatedly(const Roadmap& roadmap, const Query& query, PlanConfig config,
                           int repeat) {
  config.radius = query.radius;
  PlanResult result = plan(roadmap, query.start, query.goal, config);
  std::vector<PlanSeconds> runs = {result.seconds};
  while (runs.size() < static_cast<std::size_t>(repeat))
    runs.push_back(plan(roadmap, query.start, query.goal, config).seconds);
  for (double PlanSeconds::*part :
       {&PlanSeconds::attach, &PlanSeconds::search, &PlanSeconds::shorten, &PlanSeconds::total}) {
    const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
    std::nth_element(runs.begin(), middle, runs.end(),
                     [&](const auto& a, const auto& b) { return a.*part < b.*part; });
    result.seconds.*part = (*middle).*part;
  }
  return result;
}

Json json_of(const PlanResult& result, const Query& query, const std::string& reason) {
  Json json = Json::parse(plan_json(result));
  json["radius"] = query.radius;
  if (!result.ok()) json["reason"] = reason;
  return json;
}

void print_result(const PlanResult& result, const Query& query, const std::string& reason) {
  if (!result.ok()) {
    print_row("no path", std::string(name_of(result.status)));
    print_row("reason", reason);
    return;
  }
  const PlanSeconds& s = result.seconds;
  print_row("path", text_of(result.length) + " m, " + count_text(result.waypoints.size()) +
                        " waypoints, answered by the " + std::string(name_of(result.answered_by)));
  print_row("clearance",
            text_of(result.clearance) + " m, robot radius " + text_of(query.radius) + " m");
  print_row("beside unknown", text_of(100.0 * result.unknown_share, 0) + " % of the length");
  print_row("time", seconds_text(s.total) + " (attach " + seconds_text(s.attach) + ", search " +
                        seconds_text(s.search) + ", shorten " + seconds_text(s.shorten) + ")");
}

int run_one(const Options& options, const Roadmap& roadmap, const PlanConfig& config,
            const Globals& globals) {
  const Query query = {parse_point(options.from, "--from"), parse_point(options.to, "--to"),
                       config.radius.value_or(roadmap.min_clearance)};
  const PlanResult result = plan_repeatedly(roadmap, query, config, options.repeat);
  const std::string reason = explain(roadmap, query, result.status, options.file);
  const bool write = result.ok() && !options.output.empty();
  if (write) write_plan(result, options.output);
  if (globals.json) {
    print_json(json_of(result, query, reason));
  } else {
    print_result(result, query, reason);
    if (write)
      print_row("written to", options.output);
    else
      for (const Point& p : result.waypoints) print_row("", point_text(p));
  }
  return result.ok() ? kExitDone : kExitNoPlan;
}

int run_batch(const Options& options, const Roadmap& roadmap, const PlanConfig& config,
              const Globals& globals) {
  const std::vector<Query> queries = read_queries(
      options.queries, config.radius.value_or(roadmap.min_clearance), largest_radius(roadmap.esdf));
  Json results = Json::array();
  std::size_t solved = 0;
  for (const Query& query : queries) {
    const PlanResult result = plan_repeatedly(roadmap, query, config, options.repeat);
    const std::string reason = explain(roadmap, query, result.status, options.file);
    solved += result.ok();
    if (globals.json) {
      results.push_back(json_of(result, query, reason));
    } else if (result.ok()) {
      print_row("ok", text_of(result.length) + " m, clearance " + text_of(result.clearance) +
                          " m, " + seconds_text(result.seconds.total));
    } else {
      print_row(name_of(result.status), reason);
    }
  }
  if (globals.json)
    print_json({{"queries", queries.size()}, {"solved", solved}, {"results", results}});
  else
    print_row("solved", count_text(solved) + " of " + count_text(queries.size()));
  return solved == queries.size() ? kExitDone : kExitNoPlan;
}

int run(const Options& options, const Globals& globals) {
  const PlanConfig config = plan_config(options);
  const bool batch = !options.queries.empty();
  if (batch == (!options.from.empty() || !options.to.empty()) ||
      (!batch && (options.from.empty() || options.to.empty())))
    throw InputError("plan", "needs a start and a goal, or a file of them",
                     "give --from X,Y,Z and --to X,Y,Z, or --queries FILE alone");
  if (!batch) {  // found before the file is loaded
    parse_point(options.from, "--from");
    parse_point(options.to, "--to");
  }
  if (!options.output.empty()) {
    require_path_format(options.output);
    require_writable({options.output}, {options.file});
  }
  const Roadmap roadmap = load_roadmap(options.file);
  return batch ? run_batch(options, roadmap, config, globals)
               : run_one(options, roadmap, config, globals);
}

}  // namespace

void add_plan_command(CLI::App& app, const Globals& globals, Command& chosen) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Plan a path on a roadmap");
  command->add_option("roadmap", options->file, "Roadmap, .ridge")->required();
  command->add_option("--from", options->from, "Start X,Y,Z, metres");
  command->add_option("--to", options->to, "Goal X,Y,Z, metres");
  command->add_option("--planner", options->planner, "What is searched: graph, diagram or esdf")
      ->check(CLI::IsMember({"graph", "diagram", "esdf"}))
      ->capture_default_str();
  command->add_option("--radius", options->radius,
                      "Robot radius, metres (default: the smallest the roadmap is for)");
  command->add_flag("--raw", options->raw, "Do not shorten the path");
  command->add_option("--time-limit", options->time_limit, "Seconds (default: no limit)");
  CLI::Option* output =
      command->add_option("-o,--output", options->output, "Path to write, .csv or .json");
  command
      ->add_option("--queries", options->queries,
                   "File of queries instead, a line each: x,y,z,x,y,z[,radius]")
      ->excludes(output);
  command
      ->add_option("--repeat", options->repeat,
                   "Plan this many times and report the medians of the times")
      ->check(CLI::Range(1, 1000000));
  command->footer(
      "Exit code 2 when there is no path; the reason is in the output.\n"
      "Example:\n"
      "  ridgeway plan office.ridge --from 0,0,0.6 --to 10,0,0.6 -o path.json");
  run_when_given(*command, options, globals, chosen, run);
}

}  // namespace ridgeway::cli
