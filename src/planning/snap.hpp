// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>

#include "paths/deadline.hpp"
#include "query.hpp"

namespace ridgeway::detail {

/// Plans between two places of the local frame.
using PlanBetween = std::function<PlanResult(const Point& start, const Point& goal)>;

/// Plans with PlanConfig::snap: from the nearest usable places to a start and a goal that cannot be
/// used, of which `refused` says so. Of places from which no way leads on, those joined with them
/// are passed over too, so that each part of space around an end is tried once. `refused` where
/// there is no place; what the first places gave where no way leads between any.
PlanResult plan_snapped(const FreeSpace& space, const Point& start, const Point& goal,
                        double radius, double snap, const PlanBetween& plan_between,
                        const PlanResult& refused, const Deadline& deadline);

/// Whether a status says that start or goal cannot be used where it is.
bool is_refused(PlanStatus status);

}  // namespace ridgeway::detail
