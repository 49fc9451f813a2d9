// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>

#include "hall.hpp"

namespace ridgeway::detail {

/// Bytes that each stage has to read and write at least, once each unless its method needs more:
/// what is derived (masks, sites, distances) from what it is derived from, over the voxels that
/// have a say. Queues, lists, the voxels of a cache line that nobody asked for and second looks at
/// the same voxel come on top. Fields count as they are in memory, masks with a bit a voxel.
/// `near_sites`: whether the distance field's sites are near ones.
StageNumbers least_traffic(const BuildReport& counts, bool near_sites);

/// Voxels that each stage walks over.
StageNumbers voxels_walked(const BuildReport& counts);

/// Bytes a second, read and written, of a plain copy of `bytes` by all threads at hand: the median
/// of `repeat` copies.
double copy_bandwidth(std::size_t bytes, int repeat);

}  // namespace ridgeway::detail
