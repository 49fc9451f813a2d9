// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "live_ridges.hpp"
#include "skeleton/watershed.hpp"

namespace ridgeway::detail {

/// What find_watershed learns of each block by itself, of a field that changes.
struct LiveBasins {
  LocalWays ways = {};
};

/// Follows a field and its ridges after update_ridges: blocks in which a distance has changed, and
/// those beside it.
void update_basins(LiveBasins& basins, const LiveField& field, const LiveRidges& ridges);

/// What find_watershed gives for the field. At least one voxel is traversable.
Watershed watershed_of(const LiveBasins& basins, const LiveField& field, const LiveRidges& ridges);

}  // namespace ridgeway::detail
