// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// Here trajectories are in the map's local frame.

/// Times, seconds from the start, from which on it cannot be shown that a sphere of the radius
/// fits: the first in each segment that has one. Empty: the robot fits for certain, all along. Each
/// curve lies in the hull of its Bezier points, so where it departs from its chord by at most e it
/// is free if the chord is free at radius + e (D is 1-Lipschitz); curves are halved until that
/// holds, or one begins where it is not free, or is shorter than a thousandth of a voxel. Under
/// UnknownPolicy::kIgnore the box around the hull, or the chord where the curve is straight, must
/// lie in known-free voxels too.
std::vector<double> find_doubts(const EsdfMap& esdf, const Trajectory& trajectory, double radius);

/// Lower bound of the smallest D along a trajectory, metres, at most a millimetre too small.
double clearance_of(const EsdfMap& esdf, const Trajectory& trajectory);

}  // namespace ridgeway
