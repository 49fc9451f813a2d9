// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "convert.hpp"

namespace ridgeway::python {

/// What numbers of an array of probabilities mean.
struct Thresholds {
  double free_below = 0.5, occupied_above = 0.5;
};

/// The map of an (nx, ny, nz) array, read where it lies, at any strides: truth values (True is
/// occupied), whole numbers (VoxelState) or probabilities from 0 to 1. `origin`: low corner of the
/// voxel [0, 0, 0], metres, a whole number of voxels.
OccupancyMap map_of_array(py::handle states, double voxel_size, const Point& origin,
                          const Thresholds& thresholds);

}  // namespace ridgeway::python
