// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::detail {

/// Throws InputError where a map put together by hand has no state for each of its voxels.
inline void require_states(const OccupancyMap& map) {
  if (!map.state.is_of(map.layout))
    throw InputError("map", "has states of another layout, or none",
                     "make it with OccupancyBuilder, or `state` for the layout as it is now");
}

}  // namespace ridgeway::detail
