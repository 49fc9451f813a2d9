// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "touched_space.hpp"

#include <algorithm>
#include <cmath>

#include "ridgeway/common/parallel.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway::detail {
namespace {

/// By basin: a number that all basins of its 26-connected part share.
std::vector<std::uint32_t> part_of_basins(const LiveBasins& basins) {
  DisjointSets parts(basins.peaks.size());
  for (const auto& of_block : basins.joins)
    for (const auto& [a, b] : of_block) parts.join(a, b);
  std::vector<std::uint32_t> part(basins.peaks.size());
  for (std::uint32_t basin = 0; basin < part.size(); ++basin) part[basin] = parts.find(basin);
  return part;
}

/// The blocks around a part, and its highest level; zero where there is no such part.
struct Extent {
  BlockIndex low{}, high{};
  std::uint32_t top = 0;

  void add(const BlockIndex& block, std::uint32_t level) {
    if (top == 0) low = high = block;
    low = {std::min(low.x, block.x), std::min(low.y, block.y), std::min(low.z, block.z)};
    high = {std::max(high.x, block.x), std::max(high.y, block.y), std::max(high.z, block.z)};
    top = std::max(top, level);
  }

  /// Whether a block has changed that answers about segments inside may have looked at.
  bool touches_change(const SegmentMemory& segments) const {
    constexpr double kAround = 6.0;  // voxels: of the answers, and for what is beside the part
    const double reach = 0.5 * std::sqrt(static_cast<double>(top)) + kAround;
    const Point first(low.x, low.y, low.z), last(high.x + 1, high.y + 1, high.z + 1);
    return segments.changed().touch(kBlockSide * first - Point::Constant(reach),
                                    kBlockSide * last + Point::Constant(reach));
  }
};

/// Calls body(basin) for the basins that meet in a block.
template <typename Body>
void for_each_basin(const BasinNumbers& numbers, std::uint32_t slot, const Body& body) {
  if (numbers.whole[slot] != BasinNumbers::kSeveral) return body(numbers.whole[slot]);
  for (const std::uint32_t basin : numbers.several[slot].basins) body(basin);
}

/// By basin, whether its part is touched.
std::vector<std::uint8_t> touched_basins(const LiveBasins& basins, const BasinNumbers& numbers,
                                         const BlockLayout& layout, const SegmentMemory& segments) {
  const std::vector<std::uint32_t> part = part_of_basins(basins);
  std::vector<Extent> extents(part.size());
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    const std::uint32_t top = basins.ways.blocks[slot].top;
    if (top == 0) continue;
    for_each_basin(numbers, slot,
                   [&](std::uint32_t basin) { extents[part[basin]].add(layout.block(slot), top); });
  }
  std::vector<std::uint8_t> is_touched(part.size());
  for (std::uint32_t basin = 0; basin < part.size(); ++basin)
    if (part[basin] == basin && extents[basin].top > 0)
      is_touched[basin] = extents[basin].touches_change(segments);
  for (std::uint32_t basin = 0; basin < part.size(); ++basin)
    is_touched[basin] = is_touched[part[basin]];
  return is_touched;
}

}  // namespace

TouchedSpace all_touched(const LiveField& field, const LiveRidges& ridges) {
  return {ridges.traversable, false, std::vector<std::uint8_t>(field.esdf.layout.block_count())};
}

TouchedSpace touched_space(const LiveBasins& basins, const BasinNumbers& numbers,
                           const LiveField& field, const LiveRidges& ridges,
                           const SegmentMemory& segments) {
  const BlockLayout& layout = field.esdf.layout;
  const std::vector<std::uint8_t> is_touched = touched_basins(basins, numbers, layout, segments);
  bool is_all_touched = true;
  for (std::size_t basin = 0; basin < is_touched.size(); ++basin)
    is_all_touched &= basins.peaks[basin] == kNoVoxel || is_touched[basin] != 0;
  if (is_all_touched) return all_touched(field, ridges);
  TouchedSpace space{VoxelMask(layout), true, std::vector<std::uint8_t>(layout.block_count(), 1)};
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t i) {
        const auto slot = static_cast<std::uint32_t>(i);
        if (basins.ways.blocks[slot].top == 0) return;
        bool any = false, all = true;
        for_each_basin(numbers, slot, [&](std::uint32_t basin) {
          any |= is_touched[basin] != 0;
          all &= is_touched[basin] != 0;
        });
        if (!any) return;
        space.is_as_before[slot] = 0;
        if (all)
          space.touched.block(slot) = ridges.traversable.block(slot);
        else
          for_each_member(ridges.traversable, slot, [&](VoxelId id) {
            if (is_touched[numbers[id]] != 0) space.touched.set(id);
          });
      },
      64);
  for (const std::uint32_t slot : field.changed.slots) space.is_as_before[slot] = 0;
  return space;
}

}  // namespace ridgeway::detail
