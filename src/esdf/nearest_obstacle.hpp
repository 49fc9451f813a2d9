// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>

#include "ridgeway/esdf/surroundings.hpp"

namespace ridgeway::detail {

/// Whether the obstacle that is nearest to a place (world), within a radius (metres), is unknown
/// space: people look for a wall then, and see none.
inline bool is_unknown_nearest(const EsdfMap& esdf, const Point& place, double radius) {
  if (esdf.unknown != UnknownPolicy::kObstacle) return false;
  const PathSurroundings found = Surroundings(esdf).along(std::array{place, place}, radius);
  return found.unknown < found.known;
}

}  // namespace ridgeway::detail
