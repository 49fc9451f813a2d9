// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::detail {

/// Voxels in groups that hang together over 26 neighbours, as they come and go. After a change only
/// what is around it is looked at: where a group may have been cut, all sides of the cut are
/// followed at once until they have met, or all but one are at their ends. So it takes time by the
/// smaller side, where a flood of all groups after each change takes it by the square of their
/// size.
class SheetGroups {
 public:
  /// `sheet`, `fresh`: empty sets to work with, of the map's layout; the first has the members.
  SheetGroups(const EsdfMap& esdf, VoxelMask& sheet, VoxelMask& fresh)
      : esdf_(esdf), sheet_(sheet), fresh_(fresh) {}

  bool empty() const { return group_of_.empty(); }
  bool contains(VoxelId id) const { return sheet_.test(id); }

  /// Takes members out, each once, then others in.
  void update(const std::vector<VoxelId>& gone, const std::vector<VoxelId>& come);

  /// From each group the voxel nearest to an obstacle, in no order that means anything.
  std::vector<VoxelId> nearest();

 private:
  using Number = std::uint32_t;
  struct Group {
    std::size_t size = 0;
    std::vector<std::uint64_t> heap;  // the nearest first; of voxels that have left, too
  };

  /// By distance, then by the order of voxels.
  std::uint64_t entry_of(VoxelId id) const {
    return std::uint64_t{esdf_.squared[id]} << 32 | esdf_.layout.order_of(id);
  }
  VoxelId voxel_of_entry(std::uint64_t entry) const {
    return esdf_.layout.voxel_at_order(static_cast<std::uint32_t>(entry));
  }
  bool is_in(VoxelId id, Number group) const {
    const auto found = group_of_.find(id);
    return found != group_of_.end() && found->second == group;
  }
  template <typename Body>
  void for_each_neighbour(const VoxelMask& mask, VoxelId id, const Body& body) const;
  Number add_group(const std::vector<VoxelId>& members);
  void join(Number group, const std::vector<VoxelId>& members);
  Number merge(Number a, Number b);
  void split(Number group, const std::vector<VoxelId>& seeds);
  void take_in(VoxelId seed);

  const EsdfMap& esdf_;
  VoxelMask& sheet_;
  VoxelMask& fresh_;  // those of them that are in no group yet
  std::unordered_map<VoxelId, Number> group_of_;
  std::vector<Group> groups_;
  std::vector<Number> live_;  // and some without members
};

}  // namespace ridgeway::detail
