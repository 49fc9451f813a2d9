// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <map>
#include <span>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::detail {

/// Changes that wait until the sensor comes near them. What an update costs follows the blocks that
/// it changes, however much waits elsewhere, and no voxel waits twice.
class LiveWindow {
 public:
  /// `reach`: metres along each axis.
  LiveWindow(double reach, double voxel_size) : reach_(reach), voxel_size_(voxel_size) {}

  /// What counts now: what waited near the sensor and the new changes there (of each voxel one), of
  /// each voxel the last. The others are to wait. Nothing waits for another block than before
  /// until keep() is called.
  std::vector<VoxelChange> take_near(std::span<const VoxelChange> changes, const Point& sensor);
  /// What waits for the blocks of some changes, and then these.
  std::vector<VoxelChange> take_with(std::span<const VoxelChange> changes);
  /// All that waits.
  std::vector<VoxelChange> take_all();
  /// What was taken last counts from now on.
  void keep() noexcept;
  /// Number of changes that wait.
  std::size_t size() const { return size_; }

 private:
  using ByBlock = std::map<BlockIndex, std::vector<VoxelChange>>;  // of the lattice

  bool is_near(const BlockIndex& block, const Point& sensor) const;
  void take_waiting_near(const Point& sensor, std::vector<VoxelChange>& near);
  void take(const ByBlock::value_type& waiting, std::vector<VoxelChange>& all);
  void begin();

  const double reach_, voxel_size_;
  ByBlock waiting_;
  std::size_t size_ = 0;  // changes in it
  // What keep() makes of it: blocks that nothing waits for any more, and what waits for others.
  std::vector<BlockIndex> taken_;
  ByBlock next_;
};

}  // namespace ridgeway::detail
