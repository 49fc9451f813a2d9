// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <vector>

#include "ridge_container.hpp"
#include "ridge_header.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// How the bytes of a section are coded; a new code gets a new number.
enum RidgeType : std::uint32_t {
  kBlocksType = 1,    ///< x, y, z of the blocks as int32 planes, each less the one before
  kStateType = 2,     ///< a byte a voxel: VoxelState, plus 4 where there is no site
  kSiteType = 3,      ///< x, y, z of the offsets, less a prediction, as int8 or int16 planes
  kMaskType = 4,      ///< a bit a voxel
  kAttachType = 5,    ///< a byte a voxel: AttachField
  kVerticesType = 6,  ///< planes: voxel x, y, z (int32), clearance (double)
  kEdgesType = 7,     ///< planes: from, to (uint32), length, clearance (double)
  kTreeType = 8,      ///< planes: parent (uint32), clearance (double), place x, y, z (int32)
  kTsdfType = 9,      ///< a chunk: planes of distance and weight (float) of 128 blocks
  kNumbersType = 10,  ///< a uint32 each
};

/// Sections with a value for every voxel: state, site, diagram, attach.
/// The squared distances and the obstacle mask follow from these and are not stored.
std::vector<RidgeSectionSource> voxel_sections(const Roadmap& roadmap);
/// Throws InputError where the fields would not fit into the memory that is left.
void check_memory(const RidgeReader& reader, const RidgeHeader& header);
/// Fills esdf (the layout must stand), diagram and attach.
void load_voxels(const RidgeReader& reader, const RidgeHeader& header, Roadmap& roadmap);

/// Sections blocks, vertices, edges, tree, and those of the tangent graph: corners, taut_edges,
/// cells (how many corners are seen from each) and seen (which).
std::vector<RidgeSectionSource> list_sections(const Roadmap& roadmap);
RidgeSectionSource blocks_section(const BlockLayout& layout);
BlockLayout load_blocks(const RidgeReader& reader, std::uint32_t count);
/// Fills graph (without links), tree and tangent graph; the layout must stand.
void load_graph(const RidgeReader& reader, const RidgeHeader& header, Roadmap& roadmap);

}  // namespace ridgeway
