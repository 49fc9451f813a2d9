// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Of the radius and the height of a cylinder, for what rounding does: what touches does not
/// collide.
inline constexpr double kCylinderRounding = 1e-9;

/// Whether an upright cylinder can move along a segment: whether no obstacle cube shares volume
/// with it on the way. Lengths in voxels. The field knows nothing of cylinders: of small ones
/// every obstacle around is looked at, of others what balls around their axis leave in doubt.
bool cylinder_is_free(const EsdfMap& esdf, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double radius, double half_height);

}  // namespace ridgeway::detail
