// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway {

/// Signed distance at the centre of one of the map's own voxels, metres: to the nearest obstacle cube outside obstacles; the
/// negative of the distance to the nearest voxel cube that is no obstacle inside them. Distances
/// inside are searched for on the spot, no deeper than `deepest` metres (then -deepest): nobody
/// flies there, so no memory is spent on them. Voxels that are not allocated count as obstacles
/// (`deepest` inside) or, where unknown is ignored, as far from everything.
double signed_distance(const EsdfMap& esdf, const VoxelIndex& voxel, double deepest = 1.0);

struct DistanceAndGradient {
  double distance = 0.0;           ///< metres
  Point gradient = Point::Zero();  ///< of the distance, per metre; points away from obstacles
};

/// Trilinear interpolation of signed distances between the eight voxel centres around a point, and
/// its exact gradient, in the map's local frame (to_local). Continuous, smooth inside each cell: for optimisers. It is not
/// 1-Lipschitz and can exceed the true distance: never decide safety by it, ask FreeSpace.
/// Distances beyond max_distance count as max_distance, those below -`deepest` as that: a smaller
/// one saves time inside obstacles. Thread-safe.
DistanceAndGradient interpolate_distance(const EsdfMap& esdf, const Point& point,
                                         double deepest = 1.0);

}  // namespace ridgeway
