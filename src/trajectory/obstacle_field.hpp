// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/free_space.hpp"
#include "spline_objective.hpp"

namespace ridgeway::detail {

/// What pushes a trajectory: interpolated distances to obstacles, exact up to radius + margin.
/// Where unknown space is ignored a path must still keep out of it, without any distance: then the
/// border of known-free space pushes as an obstacle would that lies a radius behind it, within two
/// voxels of it. Where flights are limited the borders of the limits push in the same way, from
/// `margin` before them on; so do those of the map where unknown space is free. Remembers borders,
/// so it is for one thread; the map must outlive it.
DistanceField obstacle_field(const FreeSpace& space, double radius, double margin);

}  // namespace ridgeway::detail
