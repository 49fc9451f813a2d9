// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// CellGraph::open_parts of a field, for the smallest radius, metres.
std::vector<std::uint32_t> find_open_parts(const EsdfMap& esdf, double radius);

/// The part that the way of a voxel into the graph comes to first, at the smallest radius: mostly
/// after a few moves. kNotOpen where it comes to none, or the roadmap knows none.
std::uint32_t open_part_of(const Roadmap& roadmap, VoxelId from);

}  // namespace ridgeway::detail
