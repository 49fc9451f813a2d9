// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {

/// A block of a voxblox layer: words_per_voxel numbers for each of side^3 voxels, x fastest; none
/// where the file holds none.
struct VoxbloxBlock {
  VoxelIndex index;      ///< in blocks
  bool has_data = true;  ///< what the file says; the original writes false beside data
  std::vector<std::uint32_t> words;
};

/// A layer as it is in the file.
struct VoxbloxLayer {
  std::string type;         ///< "tsdf", "esdf", "occupancy", "intensity" or "skeleton"
  double voxel_size = 0.0;  ///< metres
  int side = 16;            ///< of a block, voxels
  std::vector<VoxbloxBlock> blocks;
};

/// A voxel of a TSDF of no more weight was not seen.
inline constexpr float kLeastWeight = 1e-6f;

/// Words of a voxel in layers of a type; 0 for a type that is not known.
int words_per_voxel(std::string_view type);

/// Does a file begin like one with voxblox layers?
bool is_voxblox(std::string_view bytes);

/// All layers of a file, one after the other. Throws InputError naming file, layer, block and byte.
std::vector<VoxbloxLayer> read_voxblox(std::string_view bytes, const std::string& name);

/// The bytes of layers, as the original writes and reads them.
std::string voxblox_bytes(const std::vector<VoxbloxLayer>& layers);

/// The layer of a file that says most of space: the first with voxels that were seen of types tsdf,
/// esdf and occupancy, in this order. Throws InputError where there is none.
const VoxbloxLayer& map_layer(const std::vector<VoxbloxLayer>& layers, const std::string& name);

/// Its voxels: free where the stored distance is above 0 (the odds of being occupied below one),
/// else occupied; those not observed are unknown, and so are those of an ESDF that were only
/// supposed. What is thinner than a voxel is occupied as `occupancy_of` does it, where there are
/// distances. Distances and parents are not kept: they are found again from the states.
OccupancyMap map_of_layer(const VoxbloxLayer& layer, const std::string& name);

}  // namespace ridgeway
