// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway::detail {

/// Calls body(voxel) for all voxels whose centre is no farther than `radius` metres from a place.
template <typename Body>
void for_each_in_sphere(const Point& place, double radius, double voxel_size, const Body& body) {
  const VoxelIndex low = voxel_at(place - Point::Constant(radius), voxel_size);
  const VoxelIndex high = voxel_at(place + Point::Constant(radius), voxel_size);
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (!((centre_of({x, y, z}, voxel_size) - place).norm() > radius))
          body(VoxelIndex{x, y, z});
}

/// What was accepted of the states of a fusion's voxels, to tell what is new.
struct AcceptedStates {
  /// Of the voxels of a block: neither is unknown, known alone is occupied, both are free, and open
  /// alone is occupied by what is thin (thin_surfaces.hpp).
  struct Block {
    VoxelMask::Block known{};
    VoxelMask::Block open{};  ///< before a surface, or the robot has been there

    VoxelMask::Block free() const;
  };
  /// A block that is looked at, and what it is.
  struct Found {
    std::uint32_t number;
    Block now;
    VoxelMask::Block cleared{};  ///< the robot has been there
    VoxelMask::Block vouched{};  ///< of these, where nothing was measured
  };
  std::vector<Block> blocks;              ///< by number
  std::vector<VoxelMask::Block> cleared;  ///< by number; empty where the robot clears nothing
  std::size_t places = 0;                 ///< that `cleared` has

  std::vector<Found> found;  ///< by index
  std::size_t places_now = 0;
  bool places_moved =
      false;  ///< where the robot has been is to be found anew, in what is looked at

  /// See TsdfFusion::find_changes; `all_places`: of the sensor.
  std::vector<VoxelChange> find(const TsdfBlocks& tsdf, const VoxelIndex& origin,
                                const std::vector<Point>& all_places, const FusionConfig& config);
  void accept(TsdfBlocks& tsdf) noexcept;

 private:
  void find_touched(const TsdfBlocks& tsdf, bool clears);
  void add_found(std::uint32_t number);
  void sort_found(const TsdfBlocks& tsdf);
  void add_blocks_beside(const TsdfBlocks& tsdf);
  void find_thin(const TsdfBlocks& tsdf, const FusionConfig& config);
  const VoxelMask::Block* open_in(const TsdfBlocks& tsdf, const BlockIndex& index) const;

  static constexpr std::uint32_t kNotFound = 0xffffffffu;
  std::vector<std::uint32_t> place_of_;  // by number: in `found`, or kNotFound
};

}  // namespace ridgeway::detail
