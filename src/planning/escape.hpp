// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// The nearest traversable voxel centre, within two radii, to which a straight segment leads from a
/// point too close to an obstacle: through known-free voxels, and with a distance to obstacles that
/// never falls. Nothing where there is none, and where the point is in an obstacle or unknown.
std::optional<Point> find_escape(const EsdfMap& esdf, const Point& point, double radius);

}  // namespace ridgeway::detail
