// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway::testing {

/// Shifts of a map, voxels: near, far, UTM at 0.1 m, other ways, and up to both limits.
inline std::vector<VoxelIndex> shifts_of(const OccupancyMap& map) {
  constexpr int kLimit = kMaxVoxelIndex;  // no farther from zero do voxels go
  const VoxelRange known = moved(known_range(map), map.origin);
  const VoxelIndex top = {kLimit, kLimit, kLimit}, bottom = {-kLimit, -kLimit, -kLimit};
  return {{1000, -1000, 8},
          {1'000'000, 1'000'000, -1'000'000},
          {4'650'000, 53'000'000, 4231},
          {-4'650'003, -53'000'005, -17},
          top - known.max,
          bottom - known.min};
}

inline OccupancyMap moved_map(const OccupancyMap& map, const VoxelIndex& shift) {
  OccupancyBuilder builder(map.voxel_size);
  for (VoxelId id = 0; id < map.layout.voxel_count(); ++id)
    builder.set(map.origin + map.layout.index_of(id) + shift, map.state[id]);
  return std::move(builder).finish();
}

/// Of the .ridge file, written as if the map's origin were zero.
inline std::string bytes_but_for_the_origin(Roadmap roadmap, const TemporaryFolder& folder) {
  roadmap.esdf.origin = {};
  save_roadmap(roadmap, folder / "map.ridge");
  return read_whole(folder / "map.ridge");
}

}  // namespace ridgeway::testing
