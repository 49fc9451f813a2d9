// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "experiments/exploration_flight.hpp"

namespace ridgeway::cli {

/// Of drone, camera and planner: what `explore` and `bench explore` share.
struct ExploreSettings {
  std::string camera = "pinhole", planner = "ridgeway";
  int width = 160, rows = 32;
  double vertical_angle = 60.0;  // degrees
  double sigma = 0.01, max_range = 10.0, max_yaw_rate = 90.0;
  std::optional<Box> bounds;
  ExplorationFlightConfig config;
  std::vector<Option> of_lidars, of_frontiers;

  /// All of it, checked but for what belongs to the world.
  ExplorationFlightConfig flight() const;
};
void add_explore_settings(Command& command, ExploreSettings& settings);

}  // namespace ridgeway::cli
