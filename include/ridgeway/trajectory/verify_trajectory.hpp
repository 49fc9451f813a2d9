// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/trajectory/trajectory.hpp"

namespace ridgeway {

/// The first time, seconds from the start, from which on it cannot be shown that a sphere of the
/// radius fits; nothing where all of the trajectory is free. The robot fits for certain: each curve
/// lies in the hull of its Bezier points, so where it departs from its chord by at most e it is
/// free if the chord is free at radius + e (D is 1-Lipschitz); curves are halved until that
/// holds, or a point of them is not free, or they are shorter than a thousandth of a voxel. Under
/// UnknownPolicy::kIgnore the box around the hull, or the chord where the curve is straight, must
/// lie in known-free voxels too.
std::optional<double> first_doubt(const FreeSpace& space, const EsdfMap& esdf,
                                  const Trajectory& trajectory, double radius);

/// Lower bound of the smallest D along a trajectory, metres, at most a millimetre too small.
double clearance_of(const FreeSpace& space, const Trajectory& trajectory);

}  // namespace ridgeway
