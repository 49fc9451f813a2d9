// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ridgeway/planning/plan.hpp"

namespace ridgeway {

/// Lengths, metres, of the shortest routes along the sparse graph from one start to many goals (all
/// in the world frame), not pulled tight: those of plan() with `shorten` off, all from one search.
/// Infinite where the graph has no route for the radius (finer structures may), and where start or
/// goal are no places to be. Thread-safe on one roadmap. Throws InputError as plan() does, and for
/// a radius below the smallest of the roadmap.
std::vector<double> distances_to_goals(const Roadmap& roadmap, const Point& start,
                                       std::span<const Point> goals,
                                       std::optional<double> radius = std::nullopt);

/// The plan to one of many goals.
struct GoalPlan {
  double distance = std::numeric_limits<double>::infinity();  ///< as distances_to_goals has it
  PlanResult plan;                                            ///< as plan() has it
};

/// Plans from one start to each of many goals; the results are in the order of the goals. The time
/// limit is for each. Thread-safe on one roadmap. Throws InputError as plan() does.
std::vector<GoalPlan> plan_to_many(const Roadmap& roadmap, const Point& start,
                                   std::span<const Point> goals, const PlanConfig& config = {});

/// The goal that is nearest by path, and the way there.
struct NearestGoal {
  std::optional<std::size_t> goal;  ///< its index; nothing where none can be reached
  PlanResult plan;                  ///< the path to it; else why the first goal has none
  /// What was found out about each goal; nothing about those that had to be farther.
  std::vector<std::optional<PlanStatus>> statuses;
};

/// A path over places, or the leg that has none.
struct ViaPlan {
  PlanResult plan;      ///< of all legs as one where ok, else of the leg that is not
  std::size_t leg = 0;  ///< from places[leg] to places[leg + 1]; which is not ok
};

/// plan() from each of some places (world) to the next, joined to one path. Only the first and the
/// last place may be escaped from or moved (PlanConfig::escape, snap). The time limit is of each
/// leg. Throws InputError as plan() does, and for less than two places.
ViaPlan plan_via(const Roadmap& roadmap, std::span<const Point> places,
                 const PlanConfig& config = {});

/// The goal whose plan() is shortest, and that plan; of equally near ones the first. Goals are
/// tried by their distance along the graph, and not at all where the straight line, less what
/// both ends may be moved by (PlanConfig::snap), is longer than the best path. Throws InputError as
/// plan() does, and where there are no goals.
NearestGoal plan_to_nearest(const Roadmap& roadmap, const Point& start,
                            std::span<const Point> goals, const PlanConfig& config = {});

}  // namespace ridgeway
