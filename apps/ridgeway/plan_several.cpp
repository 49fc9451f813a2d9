// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "plan_several.hpp"

#include <algorithm>
#include <string>

#include "console.hpp"
#include "plan_files.hpp"
#include "plan_output.hpp"
#include "ridgeway/planning/alternatives.hpp"
#include "ridgeway/planning/many_goals.hpp"
#include "roadmap_facts.hpp"

namespace ridgeway::cli {
namespace {

double radius_of(const PlanOptions& options, const Roadmap& roadmap) {
  return options.radius.value_or(roadmap.min_clearance);
}

/// Writes a file for each route, where any was asked for.
std::vector<std::filesystem::path> write_routes(const PlanOptions& options,
                                                const std::vector<PlanResult>& routes,
                                                const Globals& globals) {
  std::vector<std::filesystem::path> files;
  if (options.output.empty()) return files;
  for (const PlanResult& route : routes) {
    files.push_back(output_of_route(options, files.size() + 1));
    write_output(options, route, files.back());
  }
  for (std::size_t next = files.size() + 1;
       warn_of_unwritten(globals, output_of_route(options, next));)
    ++next;
  return files;
}

}  // namespace

int run_alternatives(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals) {
  const Query query = {*options.from, options.to[0], radius_of(options, roadmap)};
  const Alternatives found = plan_alternatives(
      roadmap, query.start, query.goal, *options.alternatives, plan_config(options, query.radius));
  AnswerFacts facts(roadmap, plan_config(options, options.radius));
  // Where there are no routes, planning once more tells where the ends were moved to.
  const Query planned = found.ok() ? query
                                   : as_planned(query, plan(roadmap, query.start, query.goal,
                                                            plan_config(options, query.radius)));
  const std::vector<std::filesystem::path> files = write_routes(options, found.routes, globals);
  if (globals.json) {
    Json json = {{"status", std::string(name_of(found.status))},
                 {"radius", query.radius},
                 {"complete", found.complete},
                 {"seconds", found.seconds},
                 {"routes", Json::array()}};
    if (!found.ok()) json["reason"] = facts.reason(planned, found.status);
    if (const auto blocked = facts.blocked(planned, found.status)) json.update(json_of(*blocked));
    for (const PlanResult& route : found.routes)
      json["routes"].push_back(json_of(facts, {.plan = route}, query));
    print_json(json);
    return found.ok() ? kExitDone : kExitNoPlan;
  }
  if (!found.ok()) print_row(name_of(found.status), facts.reason(planned, found.status));
  for (std::size_t i = 0; i < found.routes.size(); ++i) {
    const PlanResult& route = found.routes[i];
    print_row("route " + count_text(i + 1), text_of(route.length) + " m, clearance " +
                                                text_of(rounded_down(route.clearance)) + " m");
    if (i < files.size())
      print_row("written to", files[i].string());
    else
      for (const Point& p : route.waypoints) print_row("", point_text(p));
  }
  if (found.ok() && found.routes.size() < *options.alternatives)
    print_row("no more", found.complete ? "the graph has no others" : "the search was cut short");
  return found.ok() ? kExitDone : kExitNoPlan;
}

int run_goals(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals) {
  const Point start = *options.from;
  const std::vector<Point>& goals = options.to;
  const double radius = radius_of(options, roadmap);
  const std::vector<GoalPlan> plans =
      plan_to_many(roadmap, start, goals, plan_config(options, radius));
  AnswerFacts facts(roadmap, plan_config(options, options.radius));
  Json results = Json::array();
  std::size_t solved = 0;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const Query query = {start, goals[i], radius};
    const PlanResult& plan = plans[i].plan;
    solved += plan.ok();
    if (globals.json) {
      results.push_back(json_of(facts, {.plan = plan}, query));
      results.back()["distance"] = plans[i].distance;
    } else {
      print_line(plan, facts.reason(as_planned(query, plan), plan.status));
    }
  }
  if (globals.json)
    print_json({{"queries", goals.size()}, {"solved", solved}, {"results", results}});
  else
    print_row("solved", count_text(solved) + " of " + count_text(goals.size()));
  return solved == goals.size() ? kExitDone : kExitNoPlan;
}

int run_nearest(const PlanOptions& options, const Roadmap& roadmap, const Globals& globals) {
  const Point start = *options.from;
  const std::vector<Point>& goals = options.to;
  const double radius = radius_of(options, roadmap);
  const NearestGoal nearest = plan_to_nearest(roadmap, start, goals, plan_config(options, radius));
  const Query query = {start, goals[nearest.goal.value_or(0)], radius};
  const PlanResult& plan = nearest.plan;
  AnswerFacts facts(roadmap, plan_config(options, options.radius));
  const bool write = plan.ok() && !options.output.empty();
  if (write)
    write_output(options, plan, options.output);
  else
    warn_of_unwritten(globals, options.output);
  if (globals.json) {
    Json json = json_of(facts, {.plan = plan}, query);
    json["goal"] = nearest.goal ? Json(*nearest.goal) : Json(nullptr);
    json["goals"] = Json::array();
    for (const auto& status : nearest.statuses)
      json["goals"].push_back(status ? std::string(name_of(*status)) : "farther");
    print_json(json);
  } else {
    if (plan.ok()) print_row("nearest", point_text(query.goal));
    print_result(facts, {.plan = plan}, query);
    if (write)
      print_row("written to", options.output);
    else
      for (const Point& p : plan.waypoints) print_row("", point_text(p));
  }
  return plan.ok() ? kExitDone : kExitNoPlan;
}

}  // namespace ridgeway::cli
