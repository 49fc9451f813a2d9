// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/parallel_sort.hpp"
#include "level_peeling.hpp"
#include "parallel_deletion.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "simple_point.hpp"

namespace ridgeway {
namespace {

constexpr double kSignificantDynamics = 1.0;  // voxels

/// Voxels in ascending order of 4 d^2 / s^2, as (value << 32 | handle): those of a level are
/// deleted sub-field by sub-field, where the order of handles does not matter.
std::vector<std::uint64_t> ascending_by_distance(const EsdfMap& esdf, const VoxelMask& voxels) {
  std::vector<std::uint64_t> order;
  for (const VoxelId id : voxels.members(esdf.layout))
    order.push_back(std::uint64_t{esdf.squared[id]} << 32 | id);
  detail::parallel_sort(order.begin(), order.end());
  return order;
}

/// Asks voxels again once a neighbour of theirs is gone, but only those whose turn has come.
class OrderedDeletion {
 public:
  OrderedDeletion(const BlockLayout& layout, VoxelMask& voxels)
      : layout_(layout), voxels_(voxels), due_(layout) {}

  /// The turn of these voxels has come: deletes what may go among them and among earlier ones.
  template <typename MayGo>
  void process(std::vector<VoxelId> work, const MayGo& may_go) {
    for (const VoxelId id : work) due_.set(id);
    delete_all(std::move(work), may_go);
  }

  /// Left over from turns that have come, each once: those around which anything has changed since
  /// the last call, and some others.
  std::vector<VoxelId> take_changed(const std::vector<VoxelId>& others) {
    std::vector<VoxelId> changed = std::exchange(asked_, {});
    changed.insert(changed.end(), others.begin(), others.end());
    std::erase_if(changed, [&](VoxelId id) { return !due_.test(id); });
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
  VoxelMask due_;  // those whose turn has come and that are still there
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

/// From each connected group of sheet voxels the one nearest to an obstacle.
std::vector<VoxelId> piercing_places(const EsdfMap& esdf, const std::vector<VoxelId>& sheets) {
  VoxelMask sheet(esdf.layout);
  for (const VoxelId id : sheets) sheet.set(id);
  std::vector<VoxelId> places;
  for (const VoxelId seed : sheets) {
    if (!sheet.test(seed)) continue;
    VoxelId best = seed;
    std::vector<VoxelId> stack{seed};
    sheet.reset(seed);
    while (!stack.empty()) {
      const VoxelId id = stack.back();
      stack.pop_back();
      if (std::pair(esdf.squared[id], esdf.layout.order_of(id)) <
          std::pair(esdf.squared[best], esdf.layout.order_of(best)))
        best = id;
      for (Cube27 cube = cube_around(esdf.layout, sheet, id); cube != 0; cube &= cube - 1) {
        stack.push_back(esdf.layout.neighbour(id, std::countr_zero(cube)));
        sheet.reset(stack.back());
      }
    }
    places.push_back(best);
  }
  return places;
}

}  // namespace

VoxelMask significant_peaks(const EsdfMap& esdf, const Basins& basins) {
  VoxelMask peaks(esdf.layout);
  for (std::size_t i = 0; i < basins.peaks.size(); ++i)
    if (basins.peaks[i] != kNoVoxel && basins.dynamics[i] >= kSignificantDynamics)
      peaks.set(basins.peaks[i]);
  return peaks;
}

VoxelMask compute_kernel(const EsdfMap& esdf, const VoxelMask& traversable, const Basins& basins) {
  return detail::peel_levels(esdf, traversable, basins.not_simple_at_first_turn,
                             significant_peaks(esdf, basins));
}

void open_shells(const EsdfMap& esdf, VoxelMask& voxels, const VoxelMask& keep) {
  OrderedDeletion deletion(esdf.layout, voxels);
  const auto may_go = [&](VoxelId id, Cube27 cube) {
    return is_simple(cube) && !is_curve_end(cube) && !keep.test(id);
  };
  const auto may_be_pierced = [&](VoxelId, Cube27 cube) { return is_sheet(cube); };
  // Whole voxels of clearance are one level: dents below that are noise, not basins.
  const auto level = [](std::uint64_t squared) {
    return static_cast<std::uint32_t>(0.5 * std::sqrt(static_cast<double>(squared)));
  };
  for_each_level(ascending_by_distance(esdf, voxels), level, [&](std::vector<VoxelId> ids) {
    deletion.process(std::move(ids), may_go);
    // None of the voxels that are due is a sheet's when the next level begins, so only those can be
    // around which something has changed.
    for (std::vector<VoxelId> sheets;;) {
      sheets = deletion.take_changed(sheets);
      std::erase_if(sheets, [&](VoxelId id) {
        return keep.test(id) || !is_sheet(cube_around(esdf.layout, voxels, id));
      });
      if (sheets.empty()) break;
      deletion.process_after(piercing_places(esdf, sheets), may_be_pierced, may_go);
    }
  });
}

}  // namespace ridgeway
