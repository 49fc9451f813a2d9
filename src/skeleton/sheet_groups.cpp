// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "sheet_groups.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <utility>

#include "voxel/cube_gather.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {
namespace {

/// One side of a cut, as far as it is known.
struct Side {
  std::vector<VoxelId> members, to_follow;

  void take(VoxelId id) {
    members.push_back(id);
    to_follow.push_back(id);
  }
  void take(Side other) {
    if (other.members.size() > members.size()) std::swap(*this, other);
    members.insert(members.end(), other.members.begin(), other.members.end());
    to_follow.insert(to_follow.end(), other.to_follow.begin(), other.to_follow.end());
  }
};

}  // namespace

template <typename Body>
void SheetGroups::for_each_neighbour(const VoxelMask& mask, VoxelId id, const Body& body) const {
  for (Cube27 cube = cube_around(esdf_.layout, mask, id) & kCells26; cube != 0; cube &= cube - 1)
    body(esdf_.layout.neighbour(id, std::countr_zero(cube)));
}

SheetGroups::Number SheetGroups::add_group(const std::vector<VoxelId>& members) {
  const auto group = static_cast<Number>(groups_.size());
  groups_.emplace_back();
  live_.push_back(group);
  join(group, members);
  return group;
}

void SheetGroups::join(Number group, const std::vector<VoxelId>& members) {
  Group& joined = groups_[group];
  const bool is_new = joined.heap.empty();
  joined.size += members.size();
  for (const VoxelId id : members) {
    group_of_[id] = group;
    joined.heap.push_back(entry_of(id));
    if (!is_new) std::push_heap(joined.heap.begin(), joined.heap.end(), std::greater<>());
  }
  if (is_new) std::make_heap(joined.heap.begin(), joined.heap.end(), std::greater<>());
}

/// Returns the number that both have then.
SheetGroups::Number SheetGroups::merge(Number a, Number b) {
  if (a == b) return a;
  if (groups_[a].size < groups_[b].size) std::swap(a, b);
  std::vector<VoxelId> members;
  for (const std::uint64_t entry : std::exchange(groups_[b].heap, {}))
    if (const VoxelId id = voxel_of_entry(entry); is_in(id, b)) members.push_back(id);
  std::sort(members.begin(), members.end());  // one that left and came again is there twice
  members.erase(std::unique(members.begin(), members.end()), members.end());
  groups_[b].size = 0;
  join(a, members);
  return a;
}

/// Of a group that voxels have left: `seeds`, those beside them that are still there.
void SheetGroups::split(Number group, const std::vector<VoxelId>& seeds) {
  std::vector<Side> sides(seeds.size());
  std::unordered_map<VoxelId, Number> side_of;
  DisjointSets met(seeds.size());
  std::vector<Number> followed(seeds.size());
  for (Number i = 0; i < seeds.size(); ++i) {
    followed[i] = i;
    side_of[seeds[i]] = i;
    sides[i].take(seeds[i]);
  }
  const auto follow = [&](Number i) {  // by one voxel
    const VoxelId id = sides[i].to_follow.back();
    sides[i].to_follow.pop_back();
    for_each_neighbour(sheet_, id, [&](VoxelId other) {
      const auto [found, is_new] = side_of.try_emplace(other, i);
      if (is_new) return sides[met.find(i)].take(other);
      const Number a = met.find(i), b = met.find(found->second);
      if (a == b) return;
      Side merged = std::exchange(sides[a], {});
      merged.take(std::exchange(sides[b], {}));
      sides[met.join(a, b)] = std::move(merged);
    });
  };
  std::vector<Number> ended;
  while (followed.size() > 1) {
    std::erase_if(followed, [&](Number i) {
      if (met.find(i) != i) return true;
      if (sides[i].to_follow.empty()) {
        ended.push_back(i);
        return true;
      }
      follow(i);
      return false;
    });
  }
  if (followed.empty() && !ended.empty()) ended.pop_back();  // one side stays the group
  for (const Number i : ended) {
    groups_[group].size -= sides[i].members.size();
    add_group(sides[i].members);
  }
}

/// Joins a voxel, and those that came with it and hang together with it, with groups beside them.
void SheetGroups::take_in(VoxelId seed) {
  std::vector<VoxelId> members{seed};
  std::vector<Number> beside;
  fresh_.reset(seed);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const VoxelId id = members[i];
    if (!group_of_.empty())
      for_each_neighbour(sheet_, id, [&](VoxelId other) {
        if (const auto found = group_of_.find(other); found != group_of_.end())
          beside.push_back(found->second);
      });
    for_each_neighbour(fresh_, id, [&](VoxelId other) {
      members.push_back(other);
      fresh_.reset(other);
    });
  }
  if (beside.empty()) {
    add_group(members);
    return;
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  Number group = beside.front();
  for (const Number other : beside) group = merge(group, other);
  join(group, members);
}

void SheetGroups::update(const std::vector<VoxelId>& gone, const std::vector<VoxelId>& come) {
  std::map<Number, std::vector<VoxelId>> cut;
  for (const VoxelId id : gone) {
    const auto found = group_of_.find(id);
    cut[found->second].push_back(id);
    --groups_[found->second].size;
    group_of_.erase(found);
    sheet_.reset(id);
  }
  for (const auto& [group, ids] : cut) {
    std::vector<VoxelId> seeds;
    for (const VoxelId id : ids)
      for_each_neighbour(sheet_, id, [&](VoxelId other) { seeds.push_back(other); });
    std::sort(seeds.begin(), seeds.end());
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    if (seeds.size() > 1) split(group, seeds);
  }
  for (const VoxelId id : come) {
    sheet_.set(id);
    fresh_.set(id);
  }
  for (const VoxelId id : come)
    if (fresh_.test(id)) take_in(id);
}

std::vector<VoxelId> SheetGroups::nearest() {
  std::erase_if(live_, [&](Number group) { return groups_[group].size == 0; });
  std::vector<VoxelId> places;
  for (const Number group : live_) {
    std::vector<std::uint64_t>& heap = groups_[group].heap;
    while (!is_in(voxel_of_entry(heap.front()), group)) {
      std::pop_heap(heap.begin(), heap.end(), std::greater<>());
      heap.pop_back();
    }
    places.push_back(voxel_of_entry(heap.front()));
  }
  return places;
}

}  // namespace ridgeway::detail
