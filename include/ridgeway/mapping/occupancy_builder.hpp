// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/sensing/world.hpp"

namespace ridgeway {

/// What an allocated voxel costs at the peak, bytes, from map to roadmap. Sites that are not near
/// (NearSiteOffset) cost three more, and diagram and graph cost more where space is full of small
/// things; both are reckoned with once they are known.
inline constexpr int kPipelineBytesPerVoxel = 15;

/// Makes an OccupancyMap from voxels and boxes of voxels of the lattice that come in any order.
/// Where they overlap, occupied wins over free, free over unknown, so the order does not matter.
/// Memory follows the touched blocks; a map that would not fit the machine is refused before its
/// memory is taken. For one thread.
class OccupancyBuilder {
 public:
  /// What a builder takes and what it says of itself.
  struct Config {
    VoxelRange clip = kAllVoxels;                  ///< of the lattice; others are ignored
    int bytes_per_voxel = kPipelineBytesPerVoxel;  ///< to be reckoned with
    std::string name = "map";                      ///< file or value to name in errors
  };

  /// Throws InputError unless validate_voxel_size(voxel_size) passes.
  explicit OccupancyBuilder(double voxel_size) : OccupancyBuilder(voxel_size, Config{}) {}
  /// The same with a configuration of its own.
  OccupancyBuilder(double voxel_size, Config config);

  /// It stays where it is, as it looks at parts of itself.
  OccupancyBuilder(const OccupancyBuilder&) = delete;
  OccupancyBuilder& operator=(const OccupancyBuilder&) = delete;

  /// Voxels of the lattice that are taken.
  const VoxelRange& clip() const { return config_.clip; }

  /// Raises a voxel to a state. Throws InputError where memory would not do, or where a voxel that
  /// is not clipped away lies outside kAllVoxels, or the state is no enumerator (100, say, which is
  /// occupied elsewhere).
  void set(const VoxelIndex& voxel, VoxelState state) {
    if (state > VoxelState::kOccupied) refuse(state);
    if (state == VoxelState::kUnknown) return;
    if (!config_.clip.contains(voxel)) return require_reach_of({voxel, voxel});
    VoxelState& current = block_at(block_of(voxel))[static_cast<std::size_t>(local_of(voxel))];
    if (current < state) current = state;
  }

  /// Raises all voxels of a range to a state. Throws as `set` does.
  void fill(const VoxelRange& range, VoxelState state);

  /// The map, normalised.
  OccupancyMap finish() &&;

 private:
  using Block = std::array<VoxelState, kBlockVoxels>;

  Block& block_at(const BlockIndex& index) {
    if (last_ == nullptr || last_index_ != index) {
      last_ = &find_or_add(index);
      last_index_ = index;
    }
    return *last_;
  }
  Block& find_or_add(const BlockIndex& index);
  void require_reach_of(const VoxelRange& range) const;
  [[noreturn]] void refuse(VoxelState state) const;

  double voxel_size_;
  Config config_;
  std::size_t block_limit_;
  std::unordered_map<BlockIndex, Block*, BlockHash> table_;
  std::deque<Block> blocks_;  // addresses stay
  BlockIndex last_index_;
  Block* last_ = nullptr;
};

/// Throws InputError naming the value unless it is from 1e-6 to 1e6 metres.
void validate_voxel_size(double voxel_size, const std::string& name);

/// The same voxels with the origin at the lowest known one of each axis, on the blocks that hold a
/// known voxel, and no others: maps that differ by whole voxels, or in how they came about, become
/// the same but for the origin. A map without known voxels gets no blocks, and keeps its origin.
/// Throws InputError where a known voxel lies outside kAllVoxels of the lattice, or the known
/// voxels span more than 5e8 along an axis.
OccupancyMap normalised(OccupancyMap map);

/// What perfect knowledge of a world would give: voxels are free where their centre lies outside of
/// all solids and farther than half a voxel's diagonal from all meshes, which may be walls without
/// an inside; occupied elsewhere, and where something thinner than a voxel is, as in fused maps
/// (occupancy_of a TsdfMap), which takes a voxel more at some convex corners, too. Known in
/// `bounds` (metres) and a voxel around it. Throws InputError for a voxel size or bounds that are
/// none, or more voxels than memory holds.
OccupancyMap occupancy_of(const World& world, double voxel_size, const Box& bounds);

}  // namespace ridgeway
