// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// A mine: galleries of rough rock between the places of a jittered lattice on three levels, all
/// connected, with a few ways round. Lengths in metres.
struct TunnelConfig {
  double length = 1000.0;   ///< of all galleries together, at least; at most 1e6
  double voxel_size = 0.1;  ///< at most a fifth of the radius
  double radius = 5.0;      ///< of a gallery, give or take a third; at most 10
  double roughness = 0.25;  ///< by which the rock stands out at most; below a third of the radius
  std::uint64_t seed = 1;

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// The map of such a mine, as sensors see it: free inside, two voxels of rock around it, the rest
/// unknown. Same bytes for any number of threads. Throws InputError where memory would not do.
OccupancyMap make_tunnels(const TunnelConfig& config = {});

}  // namespace ridgeway
