// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway::cli {

/// Draws a flight and its path over the map from above, with speed, acceleration and clearance over
/// time below; PNG or SVG by the extension. An empty title: the file name of the roadmap's source.
void draw_flight(const Roadmap& roadmap, std::span<const Point> path, const TrajectoryResult& flown,
                 const TrajectoryConfig& config, const std::filesystem::path& out,
                 const std::string& title = {});

}  // namespace ridgeway::cli
