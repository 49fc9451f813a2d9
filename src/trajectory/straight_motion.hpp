// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// Motion from rest to rest along a straight segment: acceleration rises smoothly (as 10 x^3 -
/// 15 x^4 + 6 x^5, so that all derivatives up to the fourth are continuous and 0 at rest), holds,
/// falls; cruise; the mirror image. Rises take an eleventh of a stage of acceleration, or as long
/// as the limit on jerk asks. Of length L, without a limit on jerk, it lasts L / v + 1.1 v / a, or
/// sqrt(4.4 L / a) where it does not reach v: the trapezoidal profile's time, which no smooth
/// motion attains, and at most a twentieth more, at a jerk of 18.75 a^2 / v, and more on short
/// legs. Nothing for L = 0.
std::vector<TrajectorySegment> straight_motion(const Point& from, const Point& to,
                                               const MotionLimits& limits);

}  // namespace ridgeway::detail
