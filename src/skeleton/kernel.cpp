// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "level_peeling.hpp"
#include "ridgeway/skeleton/diagram.hpp"

namespace ridgeway {
namespace {

constexpr double kSignificantDynamics = 1.0;  // voxels

}  // namespace

VoxelMask significant_peaks(const EsdfMap& esdf, const Basins& basins, const VoxelMask& voxels) {
  VoxelMask peaks(esdf.layout);
  for (std::size_t i = 0; i < basins.peaks.size(); ++i)
    if (basins.peaks[i] != kNoVoxel && basins.dynamics[i] >= kSignificantDynamics &&
        voxels.test(basins.peaks[i]))
      peaks.set(basins.peaks[i]);
  return peaks;
}

VoxelMask compute_kernel(const EsdfMap& esdf, const VoxelMask& traversable, const Basins& basins) {
  return detail::peel_levels(esdf, traversable, basins.not_simple_at_first_turn,
                             significant_peaks(esdf, basins, traversable));
}

}  // namespace ridgeway
