// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_field.hpp"

namespace ridgeway {

/// A truncated signed distance field: at each voxel centre the distance to the measured surface,
/// negative behind it. Invariant: both fields are on `layout`; |distance| <= truncation.
struct TsdfMap {
  double voxel_size = 0.0;  ///< metres
  VoxelIndex origin = {};   ///< the lattice's voxel that is the map's own (0, 0, 0)
  double truncation = 0.0;  ///< metres; distances are known no farther than this
  BlockLayout layout;
  VoxelField<float> distance;  ///< metres; of no meaning where the weight is 0
  VoxelField<float> weight;    ///< how well it is known; 0: never seen
};

/// Voxels whose centre lies behind the surface are occupied, those before it free, those never
/// seen unknown. Normalised.
OccupancyMap occupancy_of(const TsdfMap& tsdf);

}  // namespace ridgeway
