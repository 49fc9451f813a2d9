// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

// What a page that follows a map is sent after a change: bytes, little-endian, as docs/viewer.md
// describes them.

/// A roadmap of nothing, on the lattice of another: what a page has that has seen none.
Roadmap nothing_like(const Roadmap& roadmap);

/// The faces between occupied and known-free voxels on the occupied voxels of one block, merged to
/// rectangles: bits 0 to 8 the lowest voxel's x, y, z in the block, 9 to 11 the side (as
/// SurfaceQuad::side), 12 to 14 and 15 to 17 width and height, less one. Each face is in one.
std::vector<std::uint32_t> block_surface(const EsdfMap& esdf, std::uint32_t slot);

/// The blocks whose surface is another than before; all of it where nothing was before. Both must
/// be snapshots of one live roadmap: blocks in the same memory are not looked at.
std::string surface_delta_layer(const EsdfMap& before, const EsdfMap& now);

/// The vertices and edges that came, went or have another clearance (delta_between).
std::string graph_delta_layer(const Roadmap& before, const Roadmap& now);

}  // namespace ridgeway
