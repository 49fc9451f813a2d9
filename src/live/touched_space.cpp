// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "touched_space.hpp"

#include <cmath>
#include <utility>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

/// Whether a block has changed that answers about segments inside a part may have looked at.
bool touches_change(const SpacePart& part, const SegmentMemory& segments) {
  constexpr double kAround = 6.0;  // voxels: of the answers, and for what is beside the part
  const double reach = 0.5 * std::sqrt(static_cast<double>(part.top)) + kAround;
  const Point first(part.low.x, part.low.y, part.low.z),
      last(part.high.x + 1, part.high.y + 1, part.high.z + 1);
  return segments.changed().touch(kBlockSide * first - Point::Constant(reach),
                                  kBlockSide * last + Point::Constant(reach));
}

}  // namespace

TouchedSpace all_touched(const LiveField& field, const LiveRidges& ridges) {
  return {ridges.traversable, false, std::vector<std::uint8_t>(field.esdf.layout.block_count())};
}

TouchedSpace touched_space(const LiveBasins& basins, const BasinNumbers& numbers,
                           const LiveField& field, const LiveRidges& ridges,
                           const SegmentMemory& segments) {
  const BlockLayout& layout = field.esdf.layout;
  const SpaceParts& parts = basins.parts;
  std::vector<std::uint8_t> is_touched(parts.parts.size());
  std::vector<std::uint8_t> is_as_before(layout.block_count(), 1);
  bool is_all_touched = true;
  for (std::size_t part = 0; part < is_touched.size(); ++part) {
    if (parts.parts[part].top == 0) continue;
    is_touched[part] = touches_change(parts.parts[part], segments);
    is_all_touched &= is_touched[part] != 0;
    if (is_touched[part] == 0) continue;
    for (const std::uint32_t slot : parts.parts[part].slots) is_as_before[slot] = 0;
  }
  if (is_all_touched) return all_touched(field, ridges);
  TouchedSpace space{VoxelMask(layout), true, std::move(is_as_before)};
  const auto basin_is_touched = [&](std::uint32_t basin) {
    return is_touched[parts.of_basin[basin]] != 0;
  };
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t i) {
        if (space.is_as_before[i] != 0) return;
        const auto slot = static_cast<std::uint32_t>(i);
        bool all = true;
        for_each_basin(numbers, slot, [&](std::uint32_t basin) { all &= basin_is_touched(basin); });
        if (all)
          space.touched.block(slot) = ridges.traversable.block(slot);
        else
          for_each_member(ridges.traversable, slot, [&](VoxelId id) {
            if (basin_is_touched(numbers[id])) space.touched.set(id);
          });
      },
      64);
  for (const std::uint32_t slot : field.changed.slots) space.is_as_before[slot] = 0;
  return space;
}

}  // namespace ridgeway::detail
