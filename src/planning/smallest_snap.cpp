// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/planning/blocked_route.hpp"

namespace ridgeway {

std::optional<double> smallest_snap(const Roadmap& roadmap, const Point& start, const Point& goal,
                                    double farthest, PlanConfig config) {
  if (!(farthest >= 0.0 && std::isfinite(farthest)))
    throw InputError("farthest", "is " + number_text(farthest), "give metres, 0 or more");
  const auto needed = [&](double snap) -> std::optional<double> {
    config.snap = snap;
    const PlanResult result = plan(roadmap, start, goal, config);
    if (!result.ok()) return std::nullopt;
    return std::max(result.moved_start.distance, result.moved_goal.distance);
  };
  std::optional<double> best;
  // From near to far: a search that fails looks at all places within the distance.
  for (double snap = std::min(roadmap.esdf.voxel_size, farthest); !best; snap *= 2.0) {
    best = needed(std::min(snap, farthest));
    if (snap >= farthest) break;
  }
  // The nearest start may have its goal far away where the next start has it near.
  for (std::optional<double> next = best; next && *next > 0.0;) {
    best = next;
    next = needed(*best * (1.0 - 1e-9));
  }
  if (best) *best *= 1.0 + 1e-9;  // for rounding
  return best;
}

}  // namespace ridgeway
