// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_window.hpp"

#include <cmath>

namespace ridgeway::detail {

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
  return all;
}

std::vector<VoxelChange> LiveWindow::take_all() {
  std::vector<VoxelChange> all;
  for (const auto& [block, waiting] : waiting_)
    all.insert(all.end(), waiting.begin(), waiting.end());
  next_ = {};
  return all;
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
