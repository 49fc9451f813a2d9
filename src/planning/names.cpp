// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>

#include "common/name_table.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

std::string_view name_of(PlanStatus status) {
  constexpr std::array<std::string_view, 12> kNames{"ok",
                                                    "start_outside_map",
                                                    "start_unknown",
                                                    "start_in_collision",
                                                    "goal_outside_map",
                                                    "goal_unknown",
                                                    "goal_in_collision",
                                                    "no_route",
                                                    "radius_too_small",
                                                    "timeout",
                                                    "start_outside_limits",
                                                    "goal_outside_limits"};
  return name_in(kNames, status);
}

namespace {
constexpr std::array<std::string_view, 10> kPlannerNames{
    "graph",      "diagram", "esdf",    "theta",           "rrtstar",
    "rrtconnect", "bitstar", "prmstar", "informedrrtstar", "given"};
}  // namespace

std::string_view name_of(Planner planner) { return name_in(kPlannerNames, planner); }

std::string_view name_of(UnknownPolicy policy) {
  constexpr std::array<std::string_view, 3> kNames{"obstacle", "ignore", "free"};
  return name_in(kNames, policy);
}

std::optional<Planner> planner_named(std::string_view name) {
  const auto found = std::find(kPlannerNames.begin(), kPlannerNames.end(), name);
  const auto planner = static_cast<Planner>(found - kPlannerNames.begin());
  if (found == kPlannerNames.end() || planner == Planner::kGiven) return std::nullopt;
  return planner;
}

void validate_planner(Planner planner) {
  if (!is_in(kPlannerNames, planner))
    throw InputError("planner", "is no enumerator of Planner",
                     "give one of its enumerators, or leave it out");
  if (planner == Planner::kGiven)
    throw InputError("planner", "is that of paths that are given", "leave it out to plan one");
}

}  // namespace ridgeway
