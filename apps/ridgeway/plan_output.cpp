// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "plan_output.hpp"

#include <cmath>

#include "console.hpp"
#include "ridgeway/formats/path_io.hpp"

namespace ridgeway::cli {

namespace {

void print_escape(const std::string& end, const Escape& escape) {
  if (escape.length > 0.0)
    print_row("escape", text_of(escape.length) + " m at the " + end + ", clearance " +
                            text_of(rounded_down(escape.clearance)) + " m");
}

void print_moved(const std::string& end, const Moved& moved) {
  if (moved.distance > 0.0)
    print_row("moved", "the " + end + " by " + text_of(moved.distance) + " m, to " +
                           point_text(moved.place));
}

}  // namespace

Json json_of(AnswerFacts& facts, const Answer& answer, const Query& query) {
  Json json = Json::parse(plan_json(answer.plan));
  json["radius"] = query.radius;
  if (answer.plan.ok()) {
    const PathSurroundings around = facts.surroundings(answer.plan.waypoints, query.radius);
    json["known"] = {{"nearest", around.known}};
    json["unknown"]["nearest"] = around.unknown;
    json["unknown"]["share"] = around.unknown_share;
    json["unknown"]["inside"] = around.unknown_inside;
  } else {
    const Query planned = as_planned(query, answer.plan);
    json["reason"] = facts.reason(planned, answer.plan.status);
    if (const auto blocked = facts.blocked(planned, answer.plan.status))
      json.update(json_of(*blocked));
  }
  if (!is_sampling(answer.plan.answered_by)) return json;
  json["iterations"] = answer.iterations;
  if (answer.plan.ok())
    json["first_solution"] = {{"seconds", answer.first_seconds}, {"length", answer.first_length}};
  return json;
}

void print_result(AnswerFacts& facts, const Answer& answer, const Query& query) {
  const PlanResult& result = answer.plan;
  if (!result.ok()) {
    print_row("no path", std::string(name_of(result.status)));
    print_row("reason", facts.reason(as_planned(query, result), result.status));
    return;
  }
  const PlanSeconds& s = result.seconds;
  print_row("path", text_of(result.length) + " m, " + count_text(result.waypoints.size()) +
                        " waypoints, answered by the " + std::string(name_of(result.answered_by)));
  print_row("within", std::isinf(result.within) ? "no bound: start and goal are one place"
                                                : text_of(rounded_up(result.within)) +
                                                      " times the shortest path at most");
  const PathSurroundings around = facts.surroundings(result.waypoints, query.radius);
  print_row("clearance", text_of(rounded_down(result.clearance)) + " m, robot radius " +
                             text_of(query.radius) + " m");
  print_row("known obstacles", std::isinf(around.known) ? "none"
                                                        : text_of(rounded_down(around.known)) +
                                                              " m away at the nearest");
  print_moved("start", result.moved_start);
  print_moved("goal", result.moved_goal);
  print_escape("start", result.escape_start);
  print_escape("goal", result.escape_goal);
  print_row("unknown space", text_of(rounded_down(around.unknown)) + " m away at the nearest, " +
                                 text_of(100.0 * around.unknown_share, 1) +
                                 " % of the length nearer than the radius; asked to " +
                                 (result.unknown == UnknownPolicy::kObstacle ? "keep clear of it"
                                  : result.unknown == UnknownPolicy::kIgnore ? "ignore it"
                                                                             : "take it for free"));
  if (result.unknown == UnknownPolicy::kFree)
    print_row("", text_of(100.0 * around.unknown_inside, 1) + " % of the length lies in it");
  print_row("time", seconds_text(s.total) + " (attach " + seconds_text(s.attach) + ", search " +
                        seconds_text(s.search) + ", shorten " + seconds_text(s.shorten) + ")");
  if (is_sampling(result.answered_by))
    print_row("first path", seconds_text(answer.first_seconds) + ", " +
                                text_of(answer.first_length) + " m; " +
                                count_text(answer.iterations) + " iterations");
}

void print_line(const PlanResult& result, const std::string& reason) {
  if (result.ok())
    print_row("ok", text_of(result.length) + " m, clearance " +
                        text_of(rounded_down(result.clearance)) + " m, " +
                        seconds_text(result.seconds.total));
  else
    print_row(name_of(result.status), reason);
}

}  // namespace ridgeway::cli
