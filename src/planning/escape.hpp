// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "lattice_search.hpp"
#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

struct EscapeResult {
  SearchStatus status = SearchStatus::kNoRoute;
  Point place = Point::Zero();  ///< if found
};

/// The nearest traversable voxel centre within two radii of a point that is no obstacle, to which
/// a straight segment leads through known-free voxels and limits along which the distance to
/// obstacles never falls. Looks no farther out than that centre, and only where the distances leave
/// room for one.
EscapeResult find_escape(const FreeSpace& space, const Point& point, double radius,
                         const Deadline& deadline);

}  // namespace ridgeway::detail
