// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <unordered_map>
#include <vector>

#include "memory_limit.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"

namespace ridgeway::detail {

/// Surfaces that are seen at a slant, or whose slant is not known, count at least so much.
inline constexpr double kLeastFacing = 0.1;

/// How much a measurement of the distance `value` counts: less far from the surface, where another
/// surface that this ray did not see may be nearer (every measurement bounds the distance from
/// above), and nothing at the depth behind it where nobody looked.
inline float gain_of(float value, const FusionConfig& config) {
  constexpr float kCarving = 0.005f;  // of a look at the surface itself
  if (value > 0.0f) return std::max(1.0f - value / static_cast<float>(config.truncation), kCarving);
  return std::max(1.0f + value / static_cast<float>(config.depth_behind), 0.0f);
}

/// Distance and weight of the voxels of one block, x fastest.
struct TsdfBlock {
  std::array<float, kBlockVoxels> distance{};
  std::array<float, kBlockVoxels> weight{};

  void add(int voxel, float value, float gain, float most) {
    if (gain <= 0.0f) return;
    float& w = weight[static_cast<std::size_t>(voxel)];
    float& d = distance[static_cast<std::size_t>(voxel)];
    d += gain / (w + gain) * (value - d);  // equal values stay as they are, to the bit
    w = std::min(w + gain, most);
  }
};

/// Blocks that are added while scans come in; their addresses stay.
class TsdfBlocks {
 public:
  TsdfBlock* find(const BlockIndex& index) {
    const auto place = table_.find(index);
    return place == table_.end() ? nullptr : place->second;
  }
  TsdfBlock& find_or_add(const BlockIndex& index) {
    TsdfBlock*& place = table_[index];
    if (place == nullptr) {
      place = &blocks_.emplace_back();
      indices_.push_back(index);
    }
    return *place;
  }
  std::size_t size() const { return blocks_.size(); }
  /// Copies all into a map, on a layout of its own.
  void copy_to(TsdfMap& map) const {
    map.layout = BlockLayout(indices_);
    map.distance = VoxelField<float>(map.layout);
    map.weight = VoxelField<float>(map.layout);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const std::uint32_t slot = map.layout.find_block(indices_[i]);
      std::copy(blocks_[i].distance.begin(), blocks_[i].distance.end(), map.distance.block(slot));
      std::copy(blocks_[i].weight.begin(), blocks_[i].weight.end(), map.weight.block(slot));
    }
  }

 private:
  std::unordered_map<BlockIndex, TsdfBlock*, BlockHash> table_;
  std::deque<TsdfBlock> blocks_;
  std::vector<BlockIndex> indices_;
};

/// Throws InputError unless there is memory for more blocks, here and in the map made of them.
inline void require_room(const TsdfBlocks& blocks, double more) {
  require_memory((static_cast<double>(blocks.size()) + 2.0 * more) * sizeof(TsdfBlock), "the map",
                 "use a larger voxel size or a smaller max_range");
}

}  // namespace ridgeway::detail
