// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// What perfect knowledge of a world would give: voxels are free where their centre lies outside of
/// all solids, occupied elsewhere; known in `bounds` (metres) and a voxel around it. Throws
/// InputError for a voxel size or bounds that are none, or more voxels than memory holds.
OccupancyMap occupancy_of(const World& world, double voxel_size, const Box& bounds);

}  // namespace ridgeway
