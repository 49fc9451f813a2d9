// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"

namespace ridgeway {

/// Signed distance at the centre of one of the map's own voxels, metres: to the nearest obstacle
/// cube outside obstacles; the negative of the distance to the nearest voxel cube that is no
/// obstacle inside them. Distances inside are searched for on the spot, no deeper than `deepest`
/// metres (then -deepest): nobody flies there, so no memory is spent on them. Voxels that are not
/// allocated count as obstacles (`deepest` inside) or, where unknown space is none, are measured
/// beside the map's blocks, and farther off count as far from everything. Throws InputError where
/// `deepest` is below 0 or not finite, as the next two do.
double signed_distance(const EsdfMap& esdf, const VoxelIndex& voxel, double deepest = 1.0);

/// How far obstacles are from a place, and in which direction that grows.
struct DistanceAndGradient {
  double distance = 0.0;           ///< metres
  Point gradient = Point::Zero();  ///< of the distance, per metre; points away from obstacles
};

/// Trilinear interpolation of signed distances between the eight voxel centres around a point, and
/// its exact gradient, in the map's local frame (to_local). Continuous, smooth inside each cell:
/// for optimisers. It is not 1-Lipschitz and can exceed the true distance: never decide safety by
/// it, ask FreeSpace. Distances beyond max_distance count as max_distance, those below -`deepest`
/// as that: a smaller one saves time inside obstacles. Thread-safe.
DistanceAndGradient interpolate_distance(const EsdfMap& esdf, const Point& point,
                                         double deepest = 1.0);

/// What voxblox answers of a point of the world (getDistanceAndGradientAtPosition): the above
/// there, or nothing where the point's voxel was never seen (isObserved).
std::optional<DistanceAndGradient> distance_at(const EsdfMap& esdf, const Point& point_world,
                                               double deepest = 1.0);

/// Signed distances to the measured surface itself, finer than a voxel: good for gradients, for
/// costs and for looking at. Not exact, so `error_bound` has to be taken off wherever safety is
/// decided; queries ask FreeSpace, which needs none of this.
struct SubvoxelDistances {
  VoxelField<float> distance;  ///< metres, on the ESDF's layout; infinite where there is no site
  double error_bound = 0.0;    ///< metres; from distances to the cubes of the ESDF, at most
};

/// Each site of the ESDF carries the point of the surface that the truncated distances around it
/// give, x - sdf grad / |grad|^2; a voxel takes the nearest of those of its own site and of its 26
/// neighbours' sites. Voxels behind the surface take their truncated distance. `tsdf`: what the
/// ESDF's map was made of (occupancy_of). Same bits for any number of threads.
/// Throws InputError where the voxel sizes differ.
SubvoxelDistances subvoxel_distances(const EsdfMap& esdf, const TsdfMap& tsdf);

}  // namespace ridgeway
