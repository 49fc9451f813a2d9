// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "esdf/remembered_space.hpp"
#include "ridgeway/skeleton/basins.hpp"

namespace ridgeway::detail {

/// Adds pieces of edges to a diagram that is exact without them, and the ways that hook each piece
/// on. All ways of `basins.next` lead to the diagram.
void hook_edges(const RememberedSpace& space, const VoxelMask& edges, SquaredHalves threshold,
                const Basins& basins, VoxelMask& diagram);

}  // namespace ridgeway::detail
