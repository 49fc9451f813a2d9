// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_window.hpp"

#include <algorithm>
#include <cmath>
#include <set>
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

/// Takes what waits near the sensor: row by row of blocks, or all of them where rows are more.
void LiveWindow::take_waiting_near(const Point& sensor, std::vector<VoxelChange>& near) {
  const auto take_from = [&](ByBlock::const_iterator block, const auto& is_beyond) {
    for (; block != waiting_.end() && !is_beyond(block->first); ++block)
      if (is_near(block->first, sensor)) take(*block, near);
  };
  const double side = kBlockSide * voxel_size_;
  const Point low = (sensor - Point::Constant(reach_)) / side - Point::Ones(),
              high = (sensor + Point::Constant(reach_)) / side + Point::Ones();
  const double rows = (high.y() - low.y() + 1.0) * (high.z() - low.z() + 1.0);
  if (!(rows < static_cast<double>(waiting_.size())))
    return take_from(waiting_.begin(), [](const BlockIndex&) { return false; });
  const auto whole = [](double value) { return static_cast<int>(std::floor(value)); };
  for (int z = whole(low.z()); z <= whole(high.z()); ++z)
    for (int y = whole(low.y()); y <= whole(high.y()); ++y)
      take_from(waiting_.lower_bound({whole(low.x()), y, z}), [&](const BlockIndex& block) {
        return block > BlockIndex{whole(high.x()), y, z};
      });
}

void LiveWindow::take(const ByBlock::value_type& waiting, std::vector<VoxelChange>& all) {
  all.insert(all.end(), waiting.second.begin(), waiting.second.end());
  taken_.push_back(waiting.first);
}

std::vector<VoxelChange> LiveWindow::take_near(std::span<const VoxelChange> changes,
                                               const Point& sensor) {
  begin();
  std::vector<VoxelChange> near;
  take_waiting_near(sensor, near);
  const bool has_waited = !near.empty();
  for (const VoxelChange& change : changes) {
    const BlockIndex block = block_of(change.voxel);
    if (std::isinf(reach_) || is_near(block, sensor)) {
      near.push_back(change);
      continue;
    }
    const auto [next, is_first] = next_.try_emplace(block);
    if (const auto waiting = waiting_.find(block); is_first && waiting != waiting_.end())
      next->second = waiting->second;
    next->second.push_back(change);
  }
  for (auto& [block, next] : next_) next = last_of_each(next);
  return has_waited ? last_of_each(near) : near;
}

std::vector<VoxelChange> LiveWindow::take_with(std::span<const VoxelChange> changes) {
  begin();
  std::vector<VoxelChange> all;
  std::set<BlockIndex> blocks;
  for (const VoxelChange& change : changes) blocks.insert(block_of(change.voxel));
  for (const BlockIndex& block : blocks)
    if (const auto waiting = waiting_.find(block); waiting != waiting_.end()) take(*waiting, all);
  all.insert(all.end(), changes.begin(), changes.end());
  return last_of_each(all);
}

std::vector<VoxelChange> LiveWindow::take_all() {
  begin();
  std::vector<VoxelChange> all;
  for (const auto& waiting : waiting_) take(waiting, all);
  return last_of_each(all);
}

void LiveWindow::begin() {
  taken_.clear();
  next_.clear();
}

void LiveWindow::keep() noexcept {
  const auto erase = [&](const BlockIndex& block) {
    const auto waiting = waiting_.find(block);
    if (waiting == waiting_.end()) return;
    size_ -= waiting->second.size();
    waiting_.erase(waiting);
  };
  for (const BlockIndex& block : taken_) erase(block);
  for (const auto& [block, next] : next_) {
    erase(block);
    size_ += next.size();
  }
  waiting_.merge(next_);
  taken_.clear();
}

}  // namespace ridgeway::detail
