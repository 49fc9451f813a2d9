// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "command.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::cli {

/// --height, --keep-in and --keep-out, which several commands have.
struct LimitOptions {
  std::vector<double> height;  ///< LOW,HIGH; empty where there is none
  std::optional<Box> keep_in;
  std::vector<Box> keep_out;

  bool any() const { return !height.empty() || keep_in || !keep_out.empty(); }
};
void add_limit_options(Command& command, LimitOptions& options);

/// World frame. Throws InputError, naming the option.
FlightLimits limits_of(const LimitOptions& options);

/// {"keep_in": [x0, y0, z0, x1, y1, z1], "keep_out": [..]}, infinite faces as null.
nlohmann::ordered_json json_of(const FlightLimits& limits);

}  // namespace ridgeway::cli
