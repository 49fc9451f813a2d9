// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "ridgeway/esdf/esdf_map.hpp"

namespace ridgeway {

struct EsdfConfig {
  UnknownPolicy unknown = UnknownPolicy::kObstacle;
  double max_distance = std::numeric_limits<double>::infinity();  ///< metres

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Exact Euclidean distances and nearest sites for all allocated voxels, batch: three separable
/// sweeps, linear in voxels, parallel, the same bytes for any number of threads. Consumes the map, whose
/// origin it keeps.
///
/// Under UnknownPolicy::kIgnore the result also allocates the blocks around the map's blocks, so
/// that every known voxel has its 26 neighbours. Throws InputError where memory would not do.
///
/// The map is taken by value, as its states become the field's: who moves it in spares a byte a
/// voxel, who hands in a copy keeps the map.
EsdfMap compute_esdf(OccupancyMap map, const EsdfConfig& config = {});

}  // namespace ridgeway
