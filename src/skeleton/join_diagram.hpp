// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "esdf/remembered_space.hpp"
#include "ridgeway/skeleton/diagram.hpp"

namespace ridgeway::detail {

/// The same, with what is remembered of moves.
VoxelMask join_diagram(const RememberedSpace& space, const VoxelMask& edges,
                       const VoxelMask& kernel, double min_clearance, Basins& basins);

}  // namespace ridgeway::detail
