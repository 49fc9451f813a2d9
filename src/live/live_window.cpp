// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_window.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace ridgeway::detail {
namespace {

struct HashOfVoxel {
  std::size_t operator()(const VoxelIndex& v) const { return hash_of(BlockIndex{v.x, v.y, v.z}); }
};

/// What the changes come to: of each voxel the last one.
std::vector<VoxelChange> last_of_each(std::span<const VoxelChange> changes) {
  std::unordered_set<VoxelIndex, HashOfVoxel> seen;
  std::vector<VoxelChange> last;
  last.reserve(changes.size());
  for (auto change = changes.rbegin(); change != changes.rend(); ++change)
    if (seen.insert(change->voxel).second) last.push_back(*change);
  std::reverse(last.begin(), last.end());
  return last;
}

}  // namespace

bool LiveWindow::is_near(const BlockIndex& block, const Point& sensor) const {
  const double side = kBlockSide * voxel_size_;
  const Point centre = Point(block.x + 0.5, block.y + 0.5, block.z + 0.5) * side;
  return (centre - sensor).cwiseAbs().maxCoeff() <= reach_;
}

std::vector<VoxelChange> LiveWindow::take_near(std::span<const VoxelChange> changes,
                                               const Point& sensor) {
  std::vector<VoxelChange> near;
  next_ = {};
  for (const auto& [block, waiting] : waiting_) {
    if (is_near(block, sensor))
      near.insert(near.end(), waiting.begin(), waiting.end());
    else
      next_.emplace(block, waiting);
  }
  if (std::isinf(reach_)) {
    near.insert(near.end(), changes.begin(), changes.end());
    return near;
  }
  for (const VoxelChange& change : changes) {
    const BlockIndex block = block_of(change.voxel);
    if (is_near(block, sensor))
      near.push_back(change);
    else
      next_[block].push_back(change);
  }
  return near;
}

std::vector<VoxelChange> LiveWindow::take_with(std::span<const VoxelChange> changes) {
  std::vector<VoxelChange> all;
  next_ = waiting_;
  for (const VoxelChange& change : changes)
    if (const auto waiting = next_.find(block_of(change.voxel)); waiting != next_.end()) {
      all.insert(all.end(), waiting->second.begin(), waiting->second.end());
      next_.erase(waiting);
    }
  all.insert(all.end(), changes.begin(), changes.end());
  return last_of_each(all);
}

std::vector<VoxelChange> LiveWindow::take_all() {
  std::vector<VoxelChange> all;
  for (const auto& [block, waiting] : waiting_)
    all.insert(all.end(), waiting.begin(), waiting.end());
  next_ = {};
  return last_of_each(all);
}

void LiveWindow::keep() noexcept {
  waiting_.swap(next_);
  next_.clear();
}

std::size_t LiveWindow::size() const {
  std::size_t count = 0;
  for (const auto& [block, waiting] : waiting_) count += waiting.size();
  return count;
}

}  // namespace ridgeway::detail
