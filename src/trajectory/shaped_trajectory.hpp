// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// A piece from a time on, seconds: its Taylor coefficients there.
TrajectorySegment tail_of(const TrajectorySegment& segment, double from);

/// What is left of a trajectory from a time on, seconds.
Trajectory tail_of(const Trajectory& trajectory, double from);

/// The rest of it: up to a time.
Trajectory head_of(const Trajectory& trajectory, double until);

/// Gives a trajectory a yaw that turns from one angle to another the short way, at the largest rate
/// from its beginning on; a stand at the end is added where turning takes longer.
void turn_to(Trajectory& trajectory, double from_yaw, double to_yaw, double max_rate);

/// Gives a trajectory's beginning, up to a time, another yaw: it turns from its first angle to one
/// on the way, stays there, and has turned to what it was then in time. Angles in radians, the time
/// and the rate such that there is time for both turns.
void turn_by_way_of(Trajectory& trajectory, double yaw_between, double until, double max_rate);

/// From one angle to another the short way, in (-pi, pi].
double turn_between(double from_yaw, double to_yaw);

}  // namespace ridgeway::detail
