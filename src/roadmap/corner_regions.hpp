// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// Number of a connected part of the sparse graph.
using Part = std::uint16_t;
inline constexpr Part kNoPart = 0xfffe;  ///< no part, more than one, or one of too many

/// The one part that the ways of all traversable voxels of a region lead to; any where there is no
/// such voxel.
std::vector<Part> parts_of_regions(const Roadmap& roadmap,
                                   const std::vector<std::uint32_t>& region_of_block,
                                   std::size_t regions);

}  // namespace ridgeway::detail
