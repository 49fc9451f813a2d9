// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "plan_output.hpp"

#include "console.hpp"
#include "ridgeway/formats/path_io.hpp"
#include "ridgeway/planning/unknown_share.hpp"

namespace ridgeway::cli {

namespace {

void print_escape(const std::string& end, const Escape& escape) {
  if (escape.length > 0.0)
    print_row("escape", text_of(escape.length) + " m at the " + end + ", clearance " +
                            text_of(escape.clearance) + " m");
}

}  // namespace

Json json_of(const EsdfMap& esdf, const Answer& answer, const Query& query,
             const std::string& reason) {
  Json json = Json::parse(plan_json(answer.plan));
  json["radius"] = query.radius;
  if (answer.plan.ok())
    json["unknown_share"] = unknown_share(esdf, answer.plan.waypoints);
  else
    json["reason"] = reason;
  if (!is_sampling(answer.plan.answered_by)) return json;
  json["iterations"] = answer.iterations;
  if (answer.plan.ok())
    json["first_solution"] = {{"seconds", answer.first_seconds}, {"length", answer.first_length}};
  return json;
}

void print_result(const EsdfMap& esdf, const Answer& answer, const Query& query,
                  const std::string& reason) {
  const PlanResult& result = answer.plan;
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
  print_escape("start", result.escape_start);
  print_escape("goal", result.escape_goal);
  print_row("beside unknown",
            text_of(100.0 * unknown_share(esdf, result.waypoints), 0) + " % of the length");
  print_row("time", seconds_text(s.total) + " (attach " + seconds_text(s.attach) + ", search " +
                        seconds_text(s.search) + ", shorten " + seconds_text(s.shorten) + ")");
  if (is_sampling(result.answered_by))
    print_row("first path", seconds_text(answer.first_seconds) + ", " +
                                text_of(answer.first_length) + " m; " +
                                count_text(answer.iterations) + " iterations");
}

void print_line(const PlanResult& result, const std::string& reason) {
  if (result.ok())
    print_row("ok", text_of(result.length) + " m, clearance " + text_of(result.clearance) + " m, " +
                        seconds_text(result.seconds.total));
  else
    print_row(name_of(result.status), reason);
}

}  // namespace ridgeway::cli
