// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ridgeway/roadmap/roadmap.hpp"
#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {

// What a page draws of a roadmap: bytes, little-endian, as docs/viewer.md describes them. Every
// layer with positions begins with its origin in the world (three f64); they are metres from there,
// or cells, so that four bytes are enough wherever the map lies.

/// Obstacles as rectangles, with the smallest cells that need `most_quads` or fewer.
std::string surface_layer(const EsdfMap& esdf, std::size_t most_quads);

/// Distances to obstacles in the horizontal layer of voxels that holds a height (world, metres).
/// Larger maps come with every second, third, ... voxel, `most_samples` along a side at most.
/// Throws InputError where the height is not finite or beyond what a voxel can have.
std::string slice_layer(const EsdfMap& esdf, double height, int most_samples);

/// Where a cut at a height (world, metres) goes through obstacles: cells that are occupied just
/// below it and not known to be free just above, which a surface of faces towards free space leaves
/// open. Of larger maps cells of 2, 3, .. voxels, `most_cells` along a side at most, that hold such
/// a voxel. Throws as slice_layer does.
std::string section_layer(const EsdfMap& esdf, double height, int most_cells);

/// Voxels of the diagram, in the order of VoxelMask::members, and the moves between neighbouring
/// ones.
std::string diagram_layer(const Roadmap& roadmap);

/// Voxels of the generalized Voronoi diagram; where there are more than `most_points` every
/// second, third, ... of them.
std::string gvd_layer(const Roadmap& roadmap, const GvdConfig& config, std::size_t most_points);

/// Vertices and edges.
std::string graph_layer(const Roadmap& roadmap);

/// The number of the component that each voxel of the diagram, or each vertex, lies in.
std::string components_layer(std::span<const std::size_t> components);

}  // namespace ridgeway
