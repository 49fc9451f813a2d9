// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <limits>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// What a field has along a ray, whose voxels are mostly in the block of the one before: memory is
/// what rays wait for. The field must stay as it is.
class FieldAlong {
 public:
  explicit FieldAlong(const EsdfMap& esdf) : esdf_(esdf), finder_(esdf.layout) {}

  void move_to(const VoxelIndex& voxel) {
    const std::uint32_t slot = finder_.find_block(block_of(voxel));
    local_ = static_cast<std::size_t>(local_of(voxel));
    if (slot == slot_) return;
    slot_ = slot;
    const bool is_known = slot != BlockLayout::kNoBlock;
    squared_ = is_known ? esdf_.squared.block(slot) : nullptr;
    state_ = is_known ? esdf_.state.block(slot) : nullptr;
  }
  /// As EsdfMap::squared; 0 where there is no voxel.
  std::uint32_t squared() const { return squared_ == nullptr ? 0 : squared_[local_]; }
  /// As EsdfMap::distance.
  double distance() const {
    return squared() == kNoSite ? std::numeric_limits<double>::infinity()
                                : SquaredHalves(squared()).metres(esdf_.voxel_size);
  }
  bool is_occupied() const { return state_ != nullptr && state_[local_] == VoxelState::kOccupied; }

 private:
  const EsdfMap& esdf_;
  VoxelFinder finder_;
  std::uint32_t slot_ = BlockLayout::kNoBlock;
  std::size_t local_ = 0;
  const std::uint32_t* squared_ = nullptr;
  const VoxelState* state_ = nullptr;
};

}  // namespace ridgeway::detail
