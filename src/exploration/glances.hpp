// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ridgeway/trajectory/trajectory.hpp"
#include "views.hpp"

namespace ridgeway::detail {

/// A place that a robot passes in flight.
struct Glance {
  double time = 0.0;      ///< seconds from the trajectory's start
  std::size_t place = 0;  ///< of those that views are of
  int heading = 0;        ///< that the robot has there
};

/// The places that a trajectory, in the frame of the places, passes up to a time: the nearest one,
/// where that is within `near` metres, at steps of time.
std::vector<Glance> glances_along(const Trajectory& trajectory, double until, const Views& views,
                                  std::span<const Place> places, double near);

/// A yaw that the robot should turn to until it has to look as its next stop does: it sees more on
/// the way then, what is seen early counting more. Radians; none where turning at once to `to_yaw`
/// is about as good, or where there is no time for both turns.
std::optional<double> yaw_between(const Views& views, int headings, std::span<const Glance> glances,
                                  double from_yaw, double to_yaw, double until, double max_rate);

}  // namespace ridgeway::detail
