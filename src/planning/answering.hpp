// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::detail {

/// plan() between places of the local frame where a robot of a radius fits, in a space that knows
/// its shape and limits: asks one structure
/// after the other, the quickest first, until the path is hardly longer than may be expected
/// (docs/how-it-works.md, "Short paths").
PlanResult plan_between(const Roadmap& roadmap, const FreeSpace& space, const Point& start,
                        const Point& goal, double radius, const PlanConfig& config,
                        const Deadline& deadline);

}  // namespace ridgeway::detail
