// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <unordered_map>
#include <vector>

#include "ridgeway/exploration/explorer.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// The free voxels of an exact world that can be seen at all: joined to the start by others, their
/// centres in straight view and within range and vertical angle of a level sensor at any of the
/// places, about half a metre apart, that a robot gets to from its start.
class ViewableVolume {
 public:
  /// Voxels of the lattice in `within`. `radius`: clearance of the robot, metres.
  ViewableVolume(const World& world, double voxel_size, const VoxelRange& within,
                 const Point& start, double radius, const FieldOfView& view);

  std::size_t voxels() const { return voxels_; }
  double volume() const { return static_cast<double>(voxels_) * voxel_volume_; }  ///< m^3

  /// About so many of them, or all, evenly taken; voxels of the lattice, ascending.
  std::vector<VoxelIndex> some(std::size_t count) const;

  /// Counts which of them a map knows; maps may share memory with the last one that was asked
  /// about. In time linear in blocks.
  std::size_t known_of(std::shared_ptr<const Roadmap> now);

 private:
  std::size_t known_in(const EsdfMap& esdf, std::uint32_t slot, const VoxelMask::Block& members);

  double voxel_volume_;
  std::size_t voxels_ = 0;
  std::unordered_map<BlockIndex, VoxelMask::Block, BlockHash> members_;  ///< of the lattice
  std::unordered_map<BlockIndex, std::size_t, BlockHash> known_;
  std::shared_ptr<const Roadmap> last_;
};

}  // namespace ridgeway
