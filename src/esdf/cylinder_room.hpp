// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// The room that an upright cylinder has around the centres of voxels, found for a block when it is
/// first asked for and kept: a search over voxels asks for thousands of moves. For one thread.
///
/// Room is a distance seen from above: from the cylinder's axis to the nearest obstacle in the
/// layers of voxels that the cylinder passes through. A square of the lattice is nearest to a move
/// between neighbours at one of its ends, unless the move goes along both axes of the plane. So a
/// move along one axis of space is free where both ends are; of others the room at their ends is a
/// bound, in all layers that the move passes through.
class CylinderRoom {
 public:
  /// Lengths in voxels.
  CylinderRoom(const EsdfMap& esdf, double radius, double half_height);

  enum class Answer : std::uint8_t { kFree, kShut, kUnclear };

  /// Whether the cylinder can move between the centres of two voxels that are neighbours, or the
  /// same. Unclear while few moves were asked for.
  Answer ask(VoxelId from, VoxelId to);

 private:
  using Room = std::uint16_t;  // 4 d^2 / s^2, and kWide where it is no less
  static constexpr Room kWide = 0xffff;
  using Layer = std::array<Room, 64>;
  using Block = std::array<Layer, kBlockSide>;

  /// 0 outside the blocks of the map.
  Room at(VoxelId id);
  Block room_of(const BlockIndex& block);
  /// The room of a cylinder as high as a voxel.
  Block layers_at(const BlockIndex& block);
  Block find_layers(const BlockIndex& block) const;

  const EsdfMap& esdf_;
  double least_ = 0.0;  // room
  int reach_ = 0;       // blocks along an axis in which obstacles count; 0: nothing is found
  int asked_ = 0;       // moves, while they are few
  int up_ = 0;          // layers that the cylinder passes through above the one of its centre
  std::vector<std::unique_ptr<Block>> layers_, rooms_;  // by slot; what was asked for
};

}  // namespace ridgeway::detail
