// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway::detail {

/// By the direction back to a parent: the neighbours that are none of the parent's, all of them
/// without one (kCentre). In a best-first search over a lattice the others need no look where the
/// parent's moves to all its neighbours are free: straight from there they are no farther.
inline constexpr std::array<Cube27, 27> kBeyondParent = [] {
  std::array<Cube27, 27> beyond{};
  for (std::size_t d = 0; d < 27; ++d)
    beyond[d] = d == kCentre ? kCells26 : kCells26 & ~grow26(Cube27{1} << d);
  return beyond;
}();

}  // namespace ridgeway::detail
