// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "diagram_memory.hpp"
#include "esdf/remembered_space.hpp"
#include "ridgeway/skeleton/diagram.hpp"

namespace ridgeway::detail {

/// As ridgeway::join_diagram, with clearances of moves that are remembered. `memory`: what a live
/// roadmap keeps of its last build; null in a batch build.
VoxelMask join_diagram(const RememberedSpace& space, const VoxelMask& edges,
                       const VoxelMask& kernel, double min_clearance, Basins& basins,
                       DiagramMemory* memory = nullptr);

}  // namespace ridgeway::detail
