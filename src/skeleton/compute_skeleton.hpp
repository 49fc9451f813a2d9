// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {

/// The skeleton diagram of what is traversable at `min_clearance` (metres), stage by stage as
/// build_roadmap makes it: ridges, thick edges, thinned edges, kernel, diagram. Throws InputError
/// where nothing is traversable, or naming the bad field; a clearance above largest_radius(esdf) is
/// one.
VoxelMask compute_skeleton(const EsdfMap& esdf, double min_clearance, const GvdConfig& config = {});

}  // namespace ridgeway
