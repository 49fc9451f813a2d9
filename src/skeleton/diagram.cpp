// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/diagram.hpp"

#include <optional>

#include "edge_hooks.hpp"
#include "esdf/measured_moves.hpp"
#include "join_diagram.hpp"
#include "kernel_joiner.hpp"
#include "redundant_voxels.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {

VoxelMask join_diagram(const EsdfMap& esdf, const VoxelMask& edges, const VoxelMask& kernel,
                       double min_clearance, Basins& basins) {
  return detail::join_diagram(detail::RememberedSpace(esdf, nullptr), edges, kernel, min_clearance,
                              basins);
}

VoxelMask detail::join_diagram(const RememberedSpace& space, const VoxelMask& edges,
                               const VoxelMask& kernel, double min_clearance, Basins& basins,
                               DiagramMemory* memory) {
  const EsdfMap& esdf = space.map();
  const SquaredHalves threshold = least_clearance(min_clearance, esdf.voxel_size);
  std::optional<MeasuredMoves> moves;
  if (space.memory() == nullptr) moves.emplace(space, united(edges, kernel));
  const RememberedSpace known(esdf, space.memory(), moves ? &*moves : nullptr);
  VoxelMask diagram = join_kernel(known, kernel, threshold, basins);
  VoxelMask all = united(edges, diagram);
  // Thins edges onto the curves that they touch.
  if (memory == nullptr)
    open_shells(esdf, all, diagram);
  else
    all = memory->shells.open(esdf, all, diagram, memory->changed());
  hook_edges(known, all, threshold, basins, diagram);
  remove_redundant_voxels(known, threshold, basins, diagram);
  return diagram;
}

}  // namespace ridgeway
