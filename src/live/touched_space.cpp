// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "touched_space.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

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
  TouchedSpace space{ridges.traversable, false, {}};
  space.slots.resize(field.esdf.layout.block_count());
  std::iota(space.slots.begin(), space.slots.end(), 0u);
  return space;
}

TouchedSpace touched_space(const LiveBasins& basins, const BasinNumbers& numbers,
                           const LiveField& field, const LiveRidges& ridges,
                           const SegmentMemory& segments) {
  const BlockLayout& layout = field.esdf.layout;
  const SpaceParts& parts = basins.parts;
  TouchedSpace space{VoxelMask(layout), false, {}};
  std::vector<std::uint8_t> is_touched(parts.parts.size()), is_named(layout.block_count());
  const auto name = [&](const std::vector<std::uint32_t>& slots) {
    for (const std::uint32_t slot : slots)
      if (std::exchange(is_named[slot], std::uint8_t{1}) == 0) space.slots.push_back(slot);
  };
  for (std::size_t part = 0; part < is_touched.size(); ++part) {
    if (parts.parts[part].top == 0) continue;
    is_touched[part] = touches_change(parts.parts[part], segments);
    if (is_touched[part] != 0)
      name(parts.parts[part].slots);
    else
      space.has_rest = true;
  }
  if (!space.has_rest) return all_touched(field, ridges);
  const auto basin_is_touched = [&](std::uint32_t basin) {
    return is_touched[parts.of_basin[basin]] != 0;
  };
  parallel_for_each_index(
      space.slots.size(),
      [&](std::size_t i) {
        const std::uint32_t slot = space.slots[i];
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
  name(field.changed.slots);
  return space;
}

}  // namespace ridgeway::detail
