// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <optional>

#include "initial_spline.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// From a motion to rest at a place nearby: two stages of acceleration, the second of which stops,
/// with smooth ramps between. A path's end has no room for what brakes fully in one curve. The
/// quickest of those tried that keeps the limits and that `holds` accepts; nothing where there is
/// none, as where the motion is too fast to stop so soon, or the place is far.
std::optional<Trajectory> arrive(const Point& from, const StartState& start, const Point& to,
                                 const MotionLimits& limits,
                                 const std::function<bool(const Trajectory&)>& holds);

}  // namespace ridgeway::detail
