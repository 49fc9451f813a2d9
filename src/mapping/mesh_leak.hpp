// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <span>

#include "mesh_map.hpp"

namespace ridgeway {

/// The widest way through free voxels from some to the outermost ones of `range`, all of the
/// lattice: where it ends and where it is narrowest. Nothing where there is no way.
std::optional<MeshLeak> find_leak(const OccupancyMap& map, std::span<const VoxelIndex> from,
                                  const VoxelRange& range);

}  // namespace ridgeway
