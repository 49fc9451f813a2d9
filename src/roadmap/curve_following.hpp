// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "diagram_curves.hpp"

namespace ridgeway::detail {

/// A piece of the diagram between two vertices: its voxels in order, vertices included.
using Curve = std::vector<DiagramNumber>;

/// Follows the diagram from all vertices at once; wherever two floods meet, a curve connects
/// their vertices (each group of adjacent meetings once, by its widest). Loops that could go round
/// an obstacle (longer than `shortest_loop` voxels) become two curves with a voxel between them
/// that counts as a vertex; shorter ones are gaps of the lattice and are left out.
std::vector<Curve> follow_curves(const DiagramCurves& curves, const DiagramFlood& flood,
                                 double shortest_loop);

}  // namespace ridgeway::detail
