// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "common/parallel_sort.hpp"
#include "parallel_deletion.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "sheet_groups.hpp"
#include "shell_memory.hpp"
#include "simple_point.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

/// Voxels in ascending order of 4 d^2 / s^2, as (value << 32 | handle): those of a level are
/// deleted sub-field by sub-field, where the order of handles does not matter.
std::vector<std::uint64_t> ascending_by_distance(const EsdfMap& esdf,
                                                 const std::vector<VoxelId>& ids) {
  std::vector<std::uint64_t> order;
  order.reserve(ids.size());
  for (const VoxelId id : ids) order.push_back(std::uint64_t{esdf.squared[id]} << 32 | id);
  detail::parallel_sort(order.begin(), order.end());
  return order;
}

/// Asks voxels again once a neighbour of theirs is gone, but only those whose turn has come.
class OrderedDeletion {
 public:
  /// `due`: an empty set to work with, of the same layout.
  OrderedDeletion(const BlockLayout& layout, VoxelMask& voxels, VoxelMask& due)
      : layout_(layout), voxels_(voxels), due_(due) {}

  /// The turn of these voxels has come: deletes what may go among them and among earlier ones.
  template <typename MayGo>
  void process(std::vector<VoxelId> work, const MayGo& may_go) {
    for (const VoxelId id : work) due_.set(id);
    delete_all(std::move(work), may_go);
  }

  /// Whether a voxel's turn has come, and it is still there.
  bool is_due(VoxelId id) const { return due_.test(id); }

  /// Voxels around which anything has changed since the last call, or that are gone, and some
  /// others, each once.
  std::vector<VoxelId> take_changed(const std::vector<VoxelId>& others) {
    std::vector<VoxelId> changed = std::exchange(asked_, {});
    changed.insert(changed.end(), others.begin(), others.end());
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    return changed;
  }

  /// Deletes voxels that may go for another reason, and then what that sets free.
  template <typename MayGoFirst, typename MayGo>
  void process_after(const std::vector<VoxelId>& first, const MayGoFirst& may_go_first,
                     const MayGo& may_go) {
    const std::vector<VoxelId> deleted =
        detail::delete_round(layout_, voxels_, first, may_go_first);
    for (const VoxelId id : deleted) due_.reset(id);
    delete_all(detail::neighbours_of(layout_, due_, deleted), may_go);
  }

 private:
  template <typename MayGo>
  void delete_all(std::vector<VoxelId> work, const MayGo& may_go) {
    while (!work.empty()) {
      asked_.insert(asked_.end(), work.begin(), work.end());
      const std::vector<VoxelId> deleted = detail::delete_round(layout_, voxels_, work, may_go);
      for (const VoxelId id : deleted) due_.reset(id);
      work = detail::neighbours_of(layout_, due_, deleted);
    }
  }

  const BlockLayout& layout_;
  VoxelMask& voxels_;
  VoxelMask& due_;  // those whose turn has come and that are still there
  std::vector<VoxelId> asked_;
};

/// Calls body(voxels of one level) for runs of equal level(value) in ascending order.
template <typename Level, typename Body>
void for_each_level(const std::vector<std::uint64_t>& order, const Level& level, const Body& body) {
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    std::vector<VoxelId> ids;
    const auto own = level(order[first] >> 32);
    for (; last < order.size() && level(order[last] >> 32) == own; ++last)
      ids.push_back(static_cast<VoxelId>(order[last]));
    body(std::move(ids));
  }
}

/// A voxel of a sheet: foreground around it hangs together, background lies on two sides of it.
bool is_sheet(Cube27 cube) { return foreground_parts(cube) == 1 && background_parts(cube) > 1; }

VoxelMask mask_of(const BlockLayout& layout, const std::vector<VoxelId>& ids) {
  VoxelMask mask(layout);
  for (const VoxelId id : ids) mask.set(id);
  return mask;
}

}  // namespace

void open_shells(const EsdfMap& esdf, VoxelMask& voxels, const VoxelMask& keep) {
  detail::ShellScratch scratch(esdf.layout);
  detail::open_shells_among(esdf, voxels, keep, voxels.members(esdf.layout), scratch);
}

namespace detail {

void open_shells_among(const EsdfMap& esdf, VoxelMask& voxels, const VoxelMask& keep,
                       const std::vector<VoxelId>& among, ShellScratch& scratch) {
  OrderedDeletion deletion(esdf.layout, voxels, scratch.due);
  const auto may_go = [&](VoxelId id, Cube27 cube) {
    return is_simple(cube) && !is_curve_end(cube) && !keep.test(id);
  };
  const auto may_be_pierced = [&](VoxelId, Cube27 cube) { return is_sheet(cube); };
  // Whole voxels of clearance are one level: dents below that are noise, not basins.
  const auto level = [](std::uint64_t squared) {
    return static_cast<std::uint32_t>(0.5 * std::sqrt(static_cast<double>(squared)));
  };
  for_each_level(ascending_by_distance(esdf, among), level, [&](std::vector<VoxelId> ids) {
    deletion.process(std::move(ids), may_go);
    // None of the voxels that are due is a sheet's when the next level begins, so only those can be
    // around which something has changed.
    SheetGroups sheets(esdf, scratch.sheet, scratch.fresh);
    for (std::vector<VoxelId> pierced;;) {
      std::vector<VoxelId> gone, come;
      for (const VoxelId id : deletion.take_changed(pierced)) {
        const bool belongs =
            deletion.is_due(id) && !keep.test(id) && is_sheet(cube_around(esdf.layout, voxels, id));
        if (belongs != sheets.contains(id)) (belongs ? come : gone).push_back(id);
      }
      sheets.update(gone, come);
      if (sheets.empty()) break;
      pierced = sheets.nearest();
      deletion.process_after(pierced, may_be_pierced, may_go);
    }
  });
  for (const VoxelId id : among) scratch.due.reset(id);
}

/// The 26-components of what is not kept, in or beside which a member, a level or what is kept has
/// become another. In `opened`, what the last set left, all their voxels are put back, and those
/// that are no members any more taken out.
std::vector<VoxelId> ShellMemory::touched(const BlockLayout& layout, const VoxelMask& voxels,
                                          const VoxelMask& keep, const VoxelMask& changed,
                                          VoxelMask& opened, VoxelMask& seen) const {
  const VoxelMask voxels_before = mask_of(layout, voxels_), kept_before = mask_of(layout, keep_);
  std::vector<VoxelId> found;
  const auto take = [&](VoxelId id) {
    seen.set(id);
    found.push_back(id);
  };
  const auto take_around = [&](VoxelId id) {
    Cube27 cube = cube_around(layout, voxels, id) & kCells26;
    if (cube != 0) cube &= ~(cube_around(layout, keep, id) | cube_around(layout, seen, id));
    for (; cube != 0; cube &= cube - 1) take(layout.neighbour(id, std::countr_zero(cube)));
  };
  for (const std::uint32_t slot : slots_of_any({&voxels, &keep, &voxels_before, &kept_before}))
    for (std::uint32_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t now = voxels.block(slot)[z], kept = keep.block(slot)[z];
      const std::uint64_t other = now ^ voxels_before.block(slot)[z];
      std::uint64_t& left = opened.block(slot)[z];
      left = (left & ~other) | (now & (other | kept));
      for (std::uint64_t bits =
               other | (kept ^ kept_before.block(slot)[z]) | (changed.block(slot)[z] & now);
           bits != 0; bits &= bits - 1) {
        const VoxelId id =
            slot * kBlockVoxels + z * 64 + static_cast<VoxelId>(std::countr_zero(bits));
        if (voxels.test(id) && !keep.test(id) && !seen.test(id)) take(id);
        take_around(id);
      }
    }
  for (std::size_t next = 0; next < found.size(); ++next) take_around(found[next]);
  for (const VoxelId id : found) {
    seen.reset(id);
    opened.set(id);
  }
  return found;
}

VoxelMask ShellMemory::open(const EsdfMap& esdf, const VoxelMask& voxels, const VoxelMask& keep,
                            const VoxelMask& changed) {
  const BlockLayout& layout = esdf.layout;
  ShellScratch scratch(layout);
  VoxelMask opened = mask_of(layout, opened_);
  const std::vector<VoxelId> among = touched(layout, voxels, keep, changed, opened, scratch.due);
  open_shells_among(esdf, opened, keep, among, scratch);
  voxels_ = voxels.members(layout);
  keep_ = keep.members(layout);
  opened_ = opened.members(layout);
  return opened;
}

}  // namespace detail

}  // namespace ridgeway
