// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "voxel_placement.hpp"

namespace ridgeway {

/// What stands at the head of an OctoMap file.
struct OctomapHeader {
  bool binary = false;      ///< .bt: two bits a child; else .ot: log-odds
  int colour_bytes = 0;     ///< per node, .ot of a ColorOcTree
  double voxel_size = 0.0;  ///< metres, leaves of the deepest level
  std::uint64_t nodes = 0;
  std::size_t data_offset = 0;
};

/// Do these bytes begin like a .bt or .ot file (the header of the first OctoMap releases included)?
bool is_octomap(std::string_view bytes);

/// Throws InputError for trees other than OcTree, ColorOcTree and OcTreeStamped, naming the id.
OctomapHeader read_octomap_header(std::string_view bytes, const std::string& name);

/// All voxels of the file at its finest level, pruned leaves expanded. A leaf of an .ot file is
/// occupied at log-odds >= 0 (probability >= 0.5), as in OctoMap itself. The whole file is checked
/// before memory is taken; throws InputError naming file, byte and remedy for a file that is cut
/// short or damaged, has no free space, or does not fit the machine. `name` is the file's.
OccupancyMap read_octomap(std::string_view bytes, const std::string& name,
                          const VoxelPlacement& placement = {});

}  // namespace ridgeway
