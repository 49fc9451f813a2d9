// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ridgeway/roadmap/roadmap.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {

/// Adds to a roadmap that was built on some 26-connected parts of space what the roadmap before has
/// of the others, `rest`: diagram, graph, clearance tree and landmarks, numbered as one build of
/// all would number them. Blocks may have come since; `changed`: those in which space may be
/// another. Returns how many voxels the diagram has more than before.
std::ptrdiff_t add_kept_parts(const Roadmap& before, const Rest& rest,
                              std::span<const std::uint32_t> changed, Roadmap& roadmap);

}  // namespace ridgeway::detail
