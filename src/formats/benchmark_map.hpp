// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <string_view>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "voxel_placement.hpp"

namespace ridgeway {

/// Does a text begin like a .3dmap file?
bool is_benchmark_map(std::string_view bytes);

/// A map of the MovingAI 3D benchmarks (.3dmap): a first line "voxel X Y Z", then a blocked cell
/// "x y z" a line. The other cells of the X x Y x Z box are free. Cell (0, 0, 0) is voxel (0, 0,
/// 0) of the lattice. Throws InputError naming file and line.
OccupancyMap read_benchmark_map(std::string_view bytes, const std::string& name, double voxel_size,
                                const VoxelPlacement& placement = {});

}  // namespace ridgeway
