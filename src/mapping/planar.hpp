// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::detail {

/// Throws InputError where an edit in three dimensions would take the layers of a planar map apart.
inline void require_three_dimensions(const OccupancyMap& map) {
  if (map.planar)
    throw InputError("map", "is planar, whose layers stay together", "do this before flatten");
}

/// The layer of a planar map's blocks that stands for all of them: the one that robots are in.
inline constexpr int kStandingLayer = 3;

/// How many voxels of the layout stand for one of the map.
inline int copies_of_a_voxel(const OccupancyMap& map) { return map.planar ? kBlockSide : 1; }

}  // namespace ridgeway::detail
