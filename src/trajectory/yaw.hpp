// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway::detail {

/// Fills in the yaw of a trajectory: towards the direction of travel at the joints of its pieces,
/// or as near to it as the limit on its rate allows; constant where the robot rises, sinks or
/// stands, and everywhere if it is not to follow. May cut pieces in two. They are monotone between
/// joints, with four continuous derivatives (three where `rows` is 4), and at rest at the ends.
void assign_yaw(Trajectory& trajectory, int rows, double max_rate, std::optional<double> start_yaw,
                bool follow);

}  // namespace ridgeway::detail
