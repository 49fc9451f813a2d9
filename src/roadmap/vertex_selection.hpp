// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "diagram_curves.hpp"

namespace ridgeway::detail {

/// Marks the diagram voxels that the graph follows: all but the spurious branches. A branch that
/// ends freely is spurious if the ball at its end reaches less than `significance` voxels beyond
/// the ball where it starts: it then adds next to no space (erosion thickness). Cycles and the
/// last voxels of a component stay.
std::vector<bool> significant_voxels(const DiagramCurves& curves, double significance);

/// Ends, junctions (three or more neighbours) and lonely voxels of the followed part of the
/// diagram; of those within `prune_radius` voxels along the diagram only the one of largest
/// clearance; and one for each connected curve that has none. In ascending order.
std::vector<DiagramNumber> select_vertices(const DiagramCurves& curves,
                                           const std::vector<bool>& followed, double prune_radius);

}  // namespace ridgeway::detail
