// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/mapping/tsdf_map.hpp"

namespace ridgeway {

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
