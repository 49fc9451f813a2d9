// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "spline_objective.hpp"

namespace ridgeway::detail {

/// What pushes a trajectory: interpolated distances to obstacles, exact up to radius + margin.
/// Where unknown space is no obstacle a path must still keep out of it, without any distance: then
/// the border of known-free space pushes as an obstacle would that lies a radius behind it, within
/// two voxels of it. Remembers borders, so it is for one thread; the map must outlive it.
DistanceField obstacle_field(const EsdfMap& esdf, double radius, double margin);

}  // namespace ridgeway::detail
