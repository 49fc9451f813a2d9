// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "minimum_spline.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// Flies a trajectory from rest to rest as fast as its limits allow, the curve staying the same:
/// speed falls with the factor of slowing down, acceleration with its square, jerk with its cube.
void scale_to_limits(Trajectory& trajectory, const MotionLimits& limits);

/// From a state in motion, which scaling would change: the smoothest spline through its knots for
/// durations that are stretched step by step until it keeps the limits, or for the last tried.
Trajectory stretch_to_limits(Smoothness smoothness, std::vector<double> durations,
                             std::span<const DerivativeMask> fixed, Eigen::MatrixXd derivatives,
                             const MotionLimits& limits);

/// Whether all limits are kept; without a yaw that of its rate is.
bool keeps_limits(const Trajectory& trajectory, const MotionLimits& limits);

}  // namespace ridgeway::detail
