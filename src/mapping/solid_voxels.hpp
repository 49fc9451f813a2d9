// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// The box that a world's planes along the axes leave open; where they leave an axis open, that
/// around the other solids. Nothing where that is open too. Without timed solids.
std::optional<Box> extent_of(const World& world);

/// A world as a map that loses no obstacle, as occupancy_of(world, ...) with its centres of voxels
/// does: voxels whose closed cube shares a point with a solid are occupied, or with the surface or
/// the inside of a mesh. The others are free; known in `bounds` (finite) and a voxel around. Throws
/// InputError, naming `name`, where memory would not do, or a mesh is 4e9 voxels from zero.
OccupancyMap touched_by(const World& world, double voxel_size, const Box& bounds,
                        const std::string& name);

}  // namespace ridgeway
