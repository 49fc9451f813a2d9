// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "thin_surfaces.hpp"

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

/// A range beyond max_range, metres, cut to a truncation more than that: it says the same of the
/// way up to max_range, and what is measured has a voxel however far away it is.
inline double as_far_as_it_counts(double range, const FusionConfig& config) {
  return std::min(range, config.max_range + config.truncation);
}

/// Distance and weight of the voxels of one block, x fastest, and, where anything is forgotten, how
/// many measurements in a row have spoken against each.
struct TsdfBlock {
  std::array<float, kBlockVoxels> distance{};
  std::array<float, kBlockVoxels> weight{};
  std::vector<std::uint8_t> doubts = {};

  /// Whether nothing was measured of any voxel.
  bool is_empty() const {
    return std::all_of(weight.begin(), weight.end(), [](float w) { return w == 0.0f; });
  }

  void add(int voxel, float value, float gain, const FusionConfig& config) {
    if (gain <= 0.0f) return;
    value = std::max(value, -static_cast<float>(config.truncation));  // depth_behind may be more
    const auto most = static_cast<float>(config.max_weight);
    float& w = weight[static_cast<std::size_t>(voxel)];
    float& d = distance[static_cast<std::size_t>(voxel)];
    if (config.forget_after > 0 && is_forgotten(voxel, value, config)) w = 0.0f;
    d += gain / (w + gain) * (value - d);  // equal values stay as they are, to the bit
    w = std::min(w + gain, most);
  }

 private:
  /// Counts a measurement; whether it is the last that it takes for a voxel to be forgotten.
  bool is_forgotten(int voxel, float value, const FusionConfig& config) {
    const auto v = static_cast<std::size_t>(voxel);
    const auto s = static_cast<float>(config.voxel_size);
    const bool was_free = distance[v] > 0.0f, is_free = value > 0.0f;
    // Where it was near, it may be occupied by a surface that is thin.
    const bool was_near = was_free && distance[v] < static_cast<float>(kNearSurface) * s;
    const bool speaks_against =
        weight[v] > 0.0f &&
        (was_free != is_free ? std::abs(value) >= 0.5f * s
                             : was_near && value >= static_cast<float>(kNearSurface + 0.5) * s);
    doubts[v] = speaks_against ? static_cast<std::uint8_t>(doubts[v] + 1) : std::uint8_t{0};
    if (doubts[v] < config.forget_after) return false;
    doubts[v] = 0;
    return true;
  }
};

/// Blocks that are added while scans come in; their addresses stay.
class TsdfBlocks {
 public:
  /// A block to be written to.
  TsdfBlock& find_or_add(const BlockIndex& index) {
    const auto [place, is_new] = table_.try_emplace(index, static_cast<std::uint32_t>(size()));
    if (is_new) add(index);
    const std::uint32_t number = place->second;
    if (!is_touched_[number]) {
      touched_.push_back(number);
      is_touched_[number] = true;
    }
    return blocks_[number];
  }
  /// As a block is at first.
  TsdfBlock fresh() const {
    TsdfBlock block;
    if (keeps_doubts_) block.doubts.resize(kBlockVoxels);
    return block;
  }
  /// Whether anything is forgotten.
  void keep_doubts(bool keep) { keeps_doubts_ = keep; }
  /// Only these blocks are to be fused into; `only` must outlive this. Nullptr: any.
  void take_only(const std::unordered_set<BlockIndex, BlockHash>* only) { only_ = only; }
  bool takes(const BlockIndex& index) const { return only_ == nullptr || only_->contains(index); }

  std::size_t size() const { return blocks_.size(); }
  const BlockIndex& index(std::uint32_t number) const { return indices_[number]; }
  const TsdfBlock& block(std::uint32_t number) const { return blocks_[number]; }

  /// Numbers of the blocks that were asked for since these were last forgotten, each once.
  const std::vector<std::uint32_t>& touched() const { return touched_; }
  void forget_touched() noexcept {
    for (const std::uint32_t number : touched_) is_touched_[number] = false;
    touched_.clear();
  }

  /// Keeps what the touched blocks hold, before they are written to, for restore().
  void keep_touched() {
    std::vector<std::unique_ptr<TsdfBlock>> kept(touched_.size());
    parallel_for_each_index(
        kept.size(),
        [&](std::size_t i) { kept[i] = std::make_unique<TsdfBlock>(blocks_[touched_[i]]); }, 16);
    std::vector<std::uint32_t> numbers = touched_;
    kept_numbers_ = std::move(numbers);
    kept_ = std::move(kept);
  }
  void restore() noexcept {
    for (std::size_t i = 0; i < kept_.size(); ++i) blocks_[kept_numbers_[i]] = std::move(*kept_[i]);
    drop_kept();
  }
  void drop_kept() noexcept {
    kept_.clear();
    kept_numbers_.clear();
  }

  /// Writes over a block that is touched and kept.
  void write_over(const BlockIndex& index, TsdfBlock&& block) noexcept {
    blocks_[table_.find(index)->second] = std::move(block);
  }
  /// A block, or nullptr.
  const TsdfBlock* find(const BlockIndex& index) const {
    const std::uint32_t number = number_of(index);
    return number == kNone ? nullptr : &blocks_[number];
  }
  /// A block's number, or kNone.
  std::uint32_t number_of(const BlockIndex& index) const {
    const auto place = table_.find(index);
    return place == table_.end() ? kNone : place->second;
  }
  static constexpr std::uint32_t kNone = 0xffffffffu;

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
  /// The block that the table has a number for already.
  void add(const BlockIndex& index) {
    try {
      if (indices_.size() == indices_.capacity()) indices_.reserve(2 * size() + 1);
      is_touched_.resize(size() + 1);
      blocks_.push_back(fresh());
    } catch (...) {
      table_.erase(index);
      throw;
    }
    indices_.push_back(index);
  }

  std::unordered_map<BlockIndex, std::uint32_t, BlockHash> table_;  // numbers
  std::deque<TsdfBlock> blocks_;                                    // by number
  std::vector<BlockIndex> indices_;
  std::vector<bool> is_touched_;
  std::vector<std::uint32_t> touched_;
  std::vector<std::unique_ptr<TsdfBlock>> kept_;  // as they were, of `kept_numbers_`
  std::vector<std::uint32_t> kept_numbers_;
  bool keeps_doubts_ = false;
  const std::unordered_set<BlockIndex, BlockHash>* only_ = nullptr;
};

/// Throws InputError unless there is memory for more blocks, here and in the map made of them.
inline void require_room(const TsdfBlocks& blocks, double more) {
  require_memory((static_cast<double>(blocks.size()) + 2.0 * more) * sizeof(TsdfBlock), "the map",
                 "use a larger voxel size or a smaller max_range");
}

}  // namespace ridgeway::detail
