// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {

/// One value for every voxel of a layout's blocks, in the layout's order.
template <typename Value>
class VoxelField {
 public:
  VoxelField() = default;
  explicit VoxelField(const BlockLayout& layout, Value initial = {})
      : values_(layout.voxel_count(), initial) {}

  Value& operator[](VoxelId id) { return values_[id]; }
  const Value& operator[](VoxelId id) const { return values_[id]; }
  std::size_t size() const { return values_.size(); }
  /// The 512 values of a block, x fastest.
  Value* block(std::uint32_t slot) { return values_.data() + std::size_t{slot} * kBlockVoxels; }
  const Value* block(std::uint32_t slot) const {
    return values_.data() + std::size_t{slot} * kBlockVoxels;
  }
  std::vector<Value>& values() { return values_; }
  const std::vector<Value>& values() const { return values_; }
  std::size_t memory_bytes() const { return values_.capacity() * sizeof(Value); }

 private:
  std::vector<Value> values_;
};

}  // namespace ridgeway
