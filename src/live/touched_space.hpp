// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "esdf/remembered_space.hpp"
#include "live_basins.hpp"

namespace ridgeway::detail {

/// Traversable space after an update, by its 26-connected parts. What the stages from the basins on
/// make of a part depends on its own voxels, on those beside them, and on obstacles no farther from
/// a segment inside the part than the part is wide: so where nothing has changed there, all that
/// was made of it is as it was.
struct TouchedSpace {
  VoxelMask touched;                 ///< parts to be built on again
  bool has_rest = false;             ///< whether there are others
  std::vector<std::uint32_t> slots;  ///< of the blocks that these reach into, or that have changed;
                                     ///< in others what the last build left still holds
};

/// All of it, and all blocks, as if nothing had been built before.
TouchedSpace all_touched(const LiveField& field, const LiveRidges& ridges);

/// After update_basins. `segments`: which knows the blocks that have changed since the last build.
TouchedSpace touched_space(const LiveBasins& basins, const BasinNumbers& numbers,
                           const LiveField& field, const LiveRidges& ridges,
                           const SegmentMemory& segments);

}  // namespace ridgeway::detail
