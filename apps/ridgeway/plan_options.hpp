// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "limit_options.hpp"
#include "quality_option.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"

namespace ridgeway::cli {

/// Options of `ridgeway plan`.
struct PlanOptions {
  std::string file, planner = "graph", output, queries;
  std::optional<Point> from, datum;  // datum: latitude, longitude, altitude; for missions
  std::vector<Point> to;
  std::optional<double> radius, time_limit, x_heading;
  QualityOption quality;
  std::optional<std::size_t> alternatives;
  double prefer_clearance = 0.0, snap = 0.0, robot_height = 0.0;
  bool raw = false, escape = false, nearest = false;
  int repeat = 1;
  LimitOptions limits;
  SamplingConfig sampling;  // of planners that sample
  std::optional<std::size_t> iteration_limit;
  std::optional<double> range;
  std::vector<Option> sampling_options;  // those that the three above come from
  std::vector<Option> exact_options;     // of planners that do not sample

  Planner chosen() const { return planner_named(planner).value_or(Planner::kGraph); }
};

inline PlanConfig plan_config(const PlanOptions& options, std::optional<double> radius) {
  PlanConfig config{.planner = options.chosen(),
                    .radius = radius,
                    .shorten = !options.raw,
                    .quick = options.quality.quick(),
                    .within = options.quality.within(),
                    .prefer_clearance = options.prefer_clearance,
                    .escape = options.escape,
                    .limits = limits_of(options.limits),
                    .snap = options.snap,
                    .robot_height = options.robot_height};
  if (options.time_limit) config.time_limit = *options.time_limit;
  return config;
}

}  // namespace ridgeway::cli
