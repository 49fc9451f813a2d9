// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <span>

#include "ridgeway/exploration/explorer.hpp"

namespace ridgeway::detail {

/// Seconds that a flight of so many metres takes from rest to rest, along a straight line and while
/// the robot turns by so many radians. An infinite length counts as a thousand kilometres.
double seconds_of_leg(const MotionLimits& limits, double length, double turn);

/// From the motion that a robot has along the roadmap to a place, and to rest there with its yaw.
/// The robot's radius is the roadmap's min_clearance. None where there is no such trajectory.
std::optional<Trajectory> fly_to_rest(const Roadmap& roadmap, const MotionLimits& limits,
                                      const Viewpoint& stop, const FlightState& state);

/// What fly_to_rest takes at most from rest to a place (world) with the same yaw, seconds, known
/// without the trajectory: none lasts longer than stop and go. Infinite where there is no path.
double most_seconds_to_rest(const Roadmap& roadmap, const MotionLimits& limits, const Point& from,
                            const Point& to);

/// A trajectory past a stop, without a halt there.
struct Passing {
  Trajectory trajectory;
  double time = 0.0;  ///< seconds from its start until the robot is where the stop is, or near
};

/// Past the first of some stops to the second, or the third where that is near, and to rest there.
/// None where there is no such trajectory, where it does not come within `near` metres of the first
/// stop, or where the robot cannot have turned to its heading by then: it is to stop there.
std::optional<Passing> fly_past(const Roadmap& roadmap, const MotionLimits& limits,
                                std::span<const Viewpoint> stops, const FlightState& state,
                                double near);

}  // namespace ridgeway::detail
