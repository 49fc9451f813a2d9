// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "diagram_curves.hpp"

namespace ridgeway::detail {

/// Ends, junctions (three or more neighbours) and lonely voxels of the diagram; of those within
/// `prune_radius` voxels along the diagram only the one of largest clearance; and one for each
/// connected curve that has none. In ascending order.
std::vector<DiagramNumber> select_vertices(const DiagramCurves& curves, double prune_radius);

}  // namespace ridgeway::detail
