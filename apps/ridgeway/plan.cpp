// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/planning/plan.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "plan_files.hpp"
#include "plan_options.hpp"
#include "plan_output.hpp"
#include "plan_several.hpp"
#include "query_file.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"
#include "roadmap_facts.hpp"

namespace ridgeway::cli {
namespace {

using Json = nlohmann::ordered_json;

SamplingConfig sampling_config(const PlanOptions& options, double radius) {
  SamplingConfig config = options.sampling;
  config.planner = options.chosen();
  config.radius = radius;
  config.shorten = !options.raw;
  config.limits = limits_of(options.limits);
  config.robot_height = options.robot_height;
  if (options.time_limit) config.time_limit = *options.time_limit;
  if (options.range) config.range = *options.range;
  if (options.iteration_limit) config.iteration_limit = *options.iteration_limit;
  return config;
}

/// Found before the file is loaded.
void validate(const PlanOptions& options) {
  const auto refuse_given = [&](const std::vector<Option>& refused, const char* problem) {
    for (const Option& option : refused)
      if (option.is_given())
        throw InputError(option.name(), problem, "leave it out with --planner " + options.planner);
  };
  if (is_sampling(options.chosen())) {
    refuse_given(options.exact_options, "is of planners that do not sample");
    return sampling_config(options, options.radius.value_or(1.0)).validate();
  }
  plan_config(options, options.radius).validate();
  refuse_given(options.sampling_options, "is of planners that sample");
}

/// Plans once; the seed of a further run is the next one.
Answer plan_once(const Roadmap& roadmap, const Query& query, const PlanOptions& options, int run) {
  if (!is_sampling(options.chosen()))
    return {.plan = plan(roadmap, query.start, query.goal, plan_config(options, query.radius))};
  SamplingConfig config = sampling_config(options, query.radius);
  config.seed += static_cast<std::uint64_t>(run);
  return plan_by_sampling(roadmap.esdf, query.start, query.goal, config,
                          [](std::string_view, double) { return !is_interrupted(); });
}

/// Plans `repeat` times; the times are then medians, the rest is of the first run.
Answer plan_repeatedly(const Roadmap& roadmap, const Query& query, const PlanOptions& options) {
  Answer answer = plan_once(roadmap, query, options, 0);
  std::vector<PlanSeconds> runs = {answer.plan.seconds};
  for (int run = 1; run < options.repeat; ++run) {
    stop_if_interrupted();
    runs.push_back(plan_once(roadmap, query, options, run).plan.seconds);
  }
  for (double PlanSeconds::*part :
       {&PlanSeconds::attach, &PlanSeconds::search, &PlanSeconds::shorten, &PlanSeconds::total}) {
    const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
    std::nth_element(runs.begin(), middle, runs.end(),
                     [&](const auto& a, const auto& b) { return a.*part < b.*part; });
    answer.plan.seconds.*part = (*middle).*part;
  }
  return answer;
}

/// Queries that are planned at once before their answers are printed: one where times are to be
/// compared, or a sampler may have more than one thread; else some for each thread.
std::size_t batch_of(const PlanOptions& options) {
  constexpr std::size_t kEach = 8;
  if (options.repeat > 1 || is_sampling(options.chosen())) return 1;
  return kEach * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

std::vector<Answer> answer_all(const Roadmap& roadmap, std::span<const Query> queries,
                               const PlanOptions& options) {
  std::vector<Answer> answers(queries.size());
  parallel_for_each_index(queries.size(), [&](std::size_t i) {
    stop_if_interrupted();
    answers[i] = plan_repeatedly(roadmap, queries[i], options);
  });
  return answers;
}

int run_one(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals) {
  const Query query = {*options.from, options.to[0],
                       options.radius.value_or(roadmap.min_clearance)};
  const Answer answer = plan_repeatedly(roadmap, query, options);
  const PlanResult& result = answer.plan;
  AnswerFacts facts(roadmap, plan_config(options, options.radius));
  const bool write = result.ok() && !options.output.empty();
  if (write)
    write_output(options, result, options.output);
  else
    warn_of_unwritten(globals, options.output);
  if (globals.json) {
    print_json(json_of(facts, answer, query));
  } else {
    print_result(facts, answer, query);
    if (write)
      print_row("written to", options.output);
    else
      for (const Point& p : result.waypoints) print_row("", point_text(p));
  }
  return result.ok() ? kExitDone : kExitNoPlan;
}

int run_batch(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals) {
  const std::vector<Query> queries =
      read_queries(options.queries, options.radius.value_or(roadmap.min_clearance),
                   largest_radius(roadmap.esdf));
  AnswerFacts facts(roadmap, plan_config(options, options.radius));
  Json results = Json::array();
  std::size_t solved = 0;
  const std::size_t most = batch_of(options);
  for (std::size_t first = 0; first < queries.size(); first += most) {
    const auto batch = std::span(queries).subspan(first, std::min(most, queries.size() - first));
    const std::vector<Answer> answers = answer_all(roadmap, batch, options);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const PlanResult& result = answers[i].plan;
      solved += result.ok();
      if (globals.json)
        results.push_back(json_of(facts, answers[i], batch[i]));
      else
        print_line(result, facts.reason(as_planned(batch[i], result), result.status));
    }
  }
  if (globals.json)
    print_json({{"queries", queries.size()}, {"solved", solved}, {"results", results}});
  else
    print_row("solved", count_text(solved) + " of " + count_text(queries.size()));
  return solved == queries.size() ? kExitDone : kExitNoPlan;
}

/// Of what answers with several paths or chooses among goals, what does not go together.
void require_one_form(const PlanOptions& options) {
  if (options.alternatives && !options.queries.empty())
    throw InputError("--alternatives", "is for one start and goal", "leave out --queries");
  const bool several = options.alternatives || options.to.size() > 1;
  if (options.alternatives && (options.to.size() > 1 || options.nearest))
    throw InputError("--alternatives", "is for one goal", "give one --to, without --nearest");
  if (options.nearest && options.to.empty())
    throw InputError("--nearest", "chooses among goals", "give several --to X,Y,Z");
  const char* form = options.alternatives ? "--alternatives"
                     : options.nearest    ? "--nearest"
                                          : "several goals";
  if ((several || options.nearest) && is_sampling(options.chosen()))
    throw InputError("--planner " + options.planner, "is for one path to one goal",
                     std::string("leave it out with ") + form);
  if ((several || options.nearest) && options.repeat > 1)
    throw InputError("--repeat", "is for one path to one goal",
                     std::string("leave it out with ") + form);
  if (options.to.size() > 1 && !options.nearest && !options.output.empty())
    throw InputError("--output", "is for one goal", "use --json for several");
}

int run(const PlanOptions& options, const Globals& globals) {
  validate(options);
  const bool batch = !options.queries.empty();
  if (batch == (options.from || !options.to.empty()) ||
      (!batch && (!options.from || options.to.empty())))
    throw InputError("plan", "needs a start and a goal, or a file of them",
                     "give --from X,Y,Z and --to X,Y,Z, or --queries FILE alone");
  require_one_form(options);
  require_outputs(options);
  if (!options.output.empty())
    require_writable({options.alternatives ? output_of_route(options, 1)
                                           : std::filesystem::path(options.output)},
                     {options.file});
  const Roadmap roadmap = load_roadmap(options.file);
  if (batch) return run_batch(options, roadmap, globals);
  if (options.alternatives) return run_alternatives(options, roadmap, globals);
  if (options.nearest) return run_nearest(options, roadmap, globals);
  return options.to.size() > 1 ? run_goals(options, roadmap, globals)
                               : run_one(options, roadmap, globals);
}

void add_exact_options(Command& command, const Option& raw, PlanOptions& options) {
  options.exact_options = {
      command.number("--prefer-clearance", options.prefer_clearance, {0.0, 1e6},
                     "What distance d from walls is worth: a metre costs 1 + it * (radius / d)^2"),
      command.flag("--escape", options.escape,
                   "Start and goal may be too close to an obstacle: leave it the short way first"),
      command.number("--snap", options.snap, kLengthsFromZero,
                     "Start and goal that cannot be used are moved to the nearest place that can, "
                     "by so many metres at most"),
      add_quality_option(
          command, options.quality,
          "quick: settle for nearly tight where the roadmap has learnt such a way; a number: go on "
          "until the path is at most so many times as long as the shortest can be, time is up, or "
          "all is searched that there is; best: 1.02")
          .excludes(raw)};
}

void add_sampling_options(Command& command, PlanOptions& options) {
  options.sampling_options = {
      command.seed(options.sampling.seed, "Of a planner that samples"),
      command.whole("--iteration-limit", options.iteration_limit, {0, 1'000'000'000'000},
                    "Rounds of a planner that samples; what ends by it repeats exactly"),
      command.number("--range", options.range, kLengths,
                     "Longest motion that a tree grows by, metres (default: 1, or 10 voxels)"),
      command.flag("--first-solution", options.sampling.first_solution,
                   "Stop sampling at the first path")};
}

}  // namespace

void add_plan_command(Command& program) {
  const auto options = std::make_shared<PlanOptions>();
  Command command = program.add("plan", "Plan a path on a roadmap");
  command.path("roadmap", options->file, "Roadmap, .ridge").required();
  command.point("--from", options->from, "Start X,Y,Z, metres");
  command.points("--to", options->to,
                 "Goal X,Y,Z, metres; several, each with its own --to, are planned to one by one");
  command.flag("--nearest", options->nearest, "Of several goals only the one nearest by path");
  command.whole("--alternatives", options->alternatives, {1, 1000},
                "Up to so many routes, shortest first, none of which can be deformed into another "
                "in sight of it; none winds around an obstacle. -o path.json writes path-1.json, "
                "path-2.json, ...");
  command.choice("--planner", options->planner,
                 {"graph", "diagram", "esdf", "theta", "rrtstar", "rrtconnect", "bitstar",
                  "prmstar", "informedrrtstar"},
                 "What is searched: graph, diagram, esdf (A* over voxels), theta (the same at any "
                 "angle); or by sampling: the others");
  command.number("--radius", options->radius, kLengths,
                 "Robot radius, metres (default: the smallest the roadmap is for)");
  command.number("--robot-height", options->robot_height, kLengthsFromZero,
                 "Metres: the robot is an upright cylinder of this height and the radius; 0: it is "
                 "a sphere");
  add_limit_options(command, options->limits);
  const Option raw = command.flag("--raw", options->raw, "Do not shorten the path");
  add_exact_options(command, raw, *options);
  command.number("--time-limit", options->time_limit, kTimeLimits,
                 "Seconds (default: no limit, 10 where the planner samples)");
  add_sampling_options(command, *options);
  const Option output =
      command.path("-o,--output", options->output,
                   "Path to write, .csv or .json; or a mission of QGroundControl, .plan");
  command.point("--datum", options->datum,
                "Latitude, longitude and altitude of the world's 0,0,0, for missions: degrees, and "
                "metres above the sea",
                "LAT,LON,ALT");
  command.number("--x-heading", options->x_heading, {-360.0, 360.0},
                 "Compass heading of the map's x axis, for missions, degrees (default: 90, so that "
                 "x is east and y north)");
  command
      .path("--queries", options->queries,
            "File of queries instead, a line each: x,y,z,x,y,z[,radius]; on all threads but with "
            "--repeat and samplers: to compare times give --threads 1")
      .excludes(output);
  command.whole("--repeat", options->repeat, {1, 1'000'000},
                "Plan this many times and report the medians of the times");
  command.footer(
      "Exit code 2 when there is no path; the reason is in the output.\n"
      "Example:\n"
      "  ridgeway plan office.ridge --from 0,0,0.6 --to 10,0,0.6 -o path.json");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
