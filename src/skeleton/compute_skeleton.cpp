// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "compute_skeleton.hpp"

#include <cmath>

#include "common/number_text.hpp"
#include "common/require.hpp"
#include "esdf/known_radius.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/skeleton/diagram.hpp"

namespace ridgeway {

VoxelMask compute_skeleton(const EsdfMap& esdf, double min_clearance, const GvdConfig& config) {
  config.validate();
  detail::require(min_clearance > 0.0 && std::isfinite(min_clearance), "min_clearance",
                  min_clearance, "give the robot's radius in metres, above 0");
  detail::require_known_radius(esdf, "min_clearance", min_clearance);
  VoxelMask traversable = traversable_voxels(esdf, min_clearance);
  if (traversable.count() == 0)
    throw InputError("min_clearance " + number_text(min_clearance),
                     "leaves no traversable voxel in this map", "give a smaller one");
  const VoxelMask gvd = compute_gvd(esdf, traversable, config);
  VoxelMask edges = esdf.planar ? gvd : extract_edges(esdf, gvd);
  thin(esdf.layout, edges);
  Basins basins = find_basins(esdf, traversable, min_clearance);
  join_background(esdf, traversable, basins.not_simple_at_first_turn);
  VoxelMask kernel = compute_kernel(esdf, traversable, basins);
  open_shells(esdf, kernel, significant_peaks(esdf, basins, traversable));
  return join_diagram(esdf, edges, kernel, min_clearance, basins);
}

}  // namespace ridgeway
