// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "distance_sweeps.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include "line_envelope.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

/// A straight row of blocks without a gap: the sweeps run along its 64 lines of voxels.
using BlockRow = std::vector<std::uint32_t>;

constexpr int forward_direction(int axis) { return axis == 0 ? 14 : axis == 1 ? 16 : 22; }

BlockRow row_from(const BlockLayout& layout, std::uint32_t start, int axis) {
  BlockRow row;
  for (std::uint32_t slot = start; slot != BlockLayout::kNoBlock;
       slot = layout.neighbour_block(slot, forward_direction(axis)))
    row.push_back(slot);
  return row;
}

/// Calls body(row) for all rows along an axis, in parallel.
template <typename Body>
void for_each_row(const BlockLayout& layout, int axis, const Body& body) {
  std::vector<std::uint32_t> starts;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    if (layout.neighbour_block(slot, opposite(forward_direction(axis))) == BlockLayout::kNoBlock)
      starts.push_back(slot);
  parallel_for_each_index(starts.size(),
                          [&](std::size_t i) { body(row_from(layout, starts[i], axis)); });
}

/// Line `line` (0..63) of voxels of a row along y (axis 1) or z (2).
struct Line {
  const BlockRow& row;
  VoxelId base;    // place of the line's first voxel in a block
  VoxelId stride;  // from voxel to voxel

  Line(const BlockRow& blocks, int axis, int line)
      : row(blocks), stride(static_cast<VoxelId>(1 << (axis * kBlockBits))) {
    const auto low = static_cast<VoxelId>(line & 7), high = static_cast<VoxelId>(line >> 3);
    base = axis == 1 ? low | high << 6 : low | high << 3;
  }

  int size() const { return static_cast<int>(row.size()) * kBlockSide; }
  VoxelId voxel(int i) const {
    return row[static_cast<std::size_t>(i / kBlockSide)] * kBlockVoxels + base +
           static_cast<VoxelId>(i % kBlockSide) * stride;
  }

  /// Calls body(place, voxel) for the places first to last of the line.
  template <typename Body>
  void for_each_voxel(int first, int last, const Body& body) const {
    for (int i = first; i <= last;) {
      VoxelId id = voxel(i);
      const int end = std::min(last + 1, (i / kBlockSide + 1) * kBlockSide);
      for (; i < end; ++i, id += stride) body(i, id);
    }
  }
};

/// What the sweeps write.
template <typename Offset>
struct SweptFields {
  VoxelField<std::uint32_t> squared;
  VoxelField<Offset> offset;
};

/// The sweep along x: the nearest obstacle of each line itself.
template <typename Offset>
class FirstSweep {
 public:
  FirstSweep(const VoxelMask& obstacle, bool solid_outside, SweptFields<Offset>& nearest)
      : obstacle_(obstacle), solid_outside_(solid_outside), nearest_(nearest) {}

  void sweep(const BlockRow& row) const {
    std::vector<Places> behind(row.size());
    for (int line = 0; line < 64; ++line) sweep_line(row, line, behind);
  }

 private:
  using Places = std::array<int, kBlockSide>;

  void sweep_line(const BlockRow& row, int line, std::vector<Places>& behind) const {
    const int size = static_cast<int>(row.size()) * kBlockSide;
    int nearest = solid_outside_ ? -1 : -kBeyond;
    for (std::size_t b = 0; b < row.size(); ++b) {
      const unsigned solid = line_in_block(row[b], line);
      for (std::size_t x = 0; x < kBlockSide; ++x) {
        nearest = solid >> x & 1 ? static_cast<int>(b * kBlockSide + x) : nearest;
        behind[b][x] = nearest;
      }
    }
    nearest = solid_outside_ ? size : kBeyond;
    for (std::size_t b = row.size(); b-- > 0;) {
      const unsigned solid = line_in_block(row[b], line);
      Places along;
      for (std::size_t x = kBlockSide; x-- > 0;) {
        const int at = static_cast<int>(b * kBlockSide + x);
        nearest = solid >> x & 1 ? at : nearest;
        const int back = behind[b][x] - at, ahead = nearest - at;
        along[x] = -back <= ahead ? back : ahead;
      }
      write(along, row[b] * kBlockVoxels + static_cast<VoxelId>(line * kBlockSide));
    }
  }

  unsigned line_in_block(std::uint32_t slot, int line) const {
    const std::uint64_t layer = obstacle_.block(slot)[static_cast<std::size_t>(line / kBlockSide)];
    return static_cast<unsigned>(layer >> (line % kBlockSide * kBlockSide));
  }

  void write(const Places& along, VoxelId id) const {
    for (const int k : along) {
      const bool is_near = k >= -Offset::kFarthest && k <= Offset::kFarthest;
      nearest_.squared[id] = is_near ? squared_halves(k) : kNoSite;
      nearest_.offset[id] = {static_cast<decltype(Offset::x)>(is_near ? k : 0), 0, 0};
      ++id;
    }
  }

  static constexpr int kBeyond = 1 << 29;  // no line is that long

  const VoxelMask& obstacle_;
  const bool solid_outside_;
  SweptFields<Offset>& nearest_;
};

/// The sweeps along y and z: which voxel of the line has the site that is nearest to each.
template <typename Offset>
class EnvelopeSweep {
 public:
  EnvelopeSweep(int axis, bool solid_outside, SweptFields<Offset>& nearest)
      : axis_(axis), solid_outside_(solid_outside), nearest_(nearest) {}

  void sweep(const BlockRow& row) const {
    Scratch scratch(row.size() * kBlockSide);
    for (int line = 0; line < 64; ++line) sweep_line(Line(row, axis_, line), scratch);
  }

 private:
  struct Scratch {
    std::vector<std::uint32_t> cost;  // of a line's voxels before the sweep, and of what follows
    std::vector<Offset> offset;       // of those that win others before the sweep
    LineEnvelope envelope;
    explicit Scratch(std::size_t size) : cost(size + 1), offset(size), envelope(size) {}
  };

  /// An obstacle hides all that lies behind it, so each run between obstacles is swept alone.
  void sweep_line(const Line& line, Scratch& scratch) const {
    std::uint32_t* cost = scratch.cost.data();
    const int size = line.size();
    line.for_each_voxel(0, size - 1, [&](int i, VoxelId id) { cost[i] = nearest_.squared[id]; });
    cost[size] = solid_outside_ ? 0 : kNoSite;
    for (int first = 0; first < size; ++first) {
      if (cost[first] == 0) continue;
      int end = first + 1;
      while (end < size && cost[end] != 0) ++end;
      find_winners(first, end, scratch);
      write_winners(line, first, end, scratch);
      first = end;
    }
  }

  void find_winners(int first, int end, Scratch& scratch) const {
    const std::uint32_t* cost = scratch.cost.data();
    LineEnvelope& envelope = scratch.envelope;
    envelope.begin(first, end - 1);
    if (first > 0 || solid_outside_) envelope.add({first - 1, 0});
    for (int i = first; i < end; ++i)
      if (cost[i] != kNoSite) envelope.add_before({i, cost[i]}, cost[i + 1]);
    if (cost[end] == 0) envelope.add({end, 0});
  }

  void write_winners(const Line& line, int first, int end, Scratch& scratch) const {
    const auto is_inside = [&](int winner) { return winner >= first && winner < end; };
    // A voxel alone with its own site keeps it.
    const auto for_each_stretch = [&](const auto& body) {
      scratch.envelope.for_each_stretch([&](int from, int to, int winner) {
        if (winner != from || to != from + 1) body(from, to, winner);
      });
    };
    for_each_stretch([&](int, int, int winner) {  // before any of them is written over
      if (is_inside(winner))
        scratch.offset[static_cast<std::size_t>(winner)] = nearest_.offset[line.voxel(winner)];
    });
    for_each_stretch([&](int from, int to, int winner) {
      const auto w = static_cast<std::size_t>(winner);
      Offset offset = is_inside(winner) ? scratch.offset[w] : Offset{};
      const std::uint32_t across = is_inside(winner) ? scratch.cost[w] : 0;
      line.for_each_voxel(from, to - 1, [&](int i, VoxelId id) {
        const int along = std::clamp(winner - i, -Offset::kFarthest - 1, Offset::kFarthest + 1);
        (axis_ == 1 ? offset.y : offset.z) = static_cast<decltype(Offset::x)>(along);
        nearest_.offset[id] = offset;
        nearest_.squared[id] = across + squared_halves(along);
      });
    });
  }

  const int axis_;
  const bool solid_outside_;
  SweptFields<Offset>& nearest_;
};

template <typename Offset>
NearestSites sweep(const BlockLayout& layout, const VoxelMask& obstacle, bool solid_outside,
                   int axes) {
  require_memory_for_blocks(layout.block_count(), sizeof(std::uint32_t) + sizeof(Offset), "map");
  SweptFields<Offset> nearest{VoxelField<std::uint32_t>::unset(layout, Pages::kLarge),
                              VoxelField<Offset>::unset(layout)};
  const FirstSweep first(obstacle, solid_outside, nearest);
  for_each_row(layout, 0, [&](const BlockRow& row) { first.sweep(row); });
  for (int axis = 1; axis < axes; ++axis) {
    const EnvelopeSweep next(axis, solid_outside, nearest);
    for_each_row(layout, axis, [&](const BlockRow& row) { next.sweep(row); });
  }
  return {std::move(nearest.squared), SiteField(std::move(nearest.offset))};
}

/// Bounds on the distances in a block, from what they are in those of its row: 4 d^2 to an obstacle
/// that is somewhere in a block so many blocks on grows by that much along the axis, at most.
void bound_along(const BlockRow& row, bool solid_outside, std::vector<std::uint32_t>& bound) {
  const auto most_along = [](int blocks) { return squared_halves(kBlockSide * (blocks + 1) - 1); };
  const int size = static_cast<int>(row.size());
  std::vector<std::uint32_t> before(row.size() + 2, solid_outside ? 0 : kNoSite);  // with both ends
  for (std::size_t i = 0; i < row.size(); ++i) before[i + 1] = bound[row[i]];
  for (int i = 1; i <= size; ++i) {
    std::uint32_t least = kNoSite;
    const auto look = [&](int from, int blocks) {
      if (from < 0 || from > size + 1) return;
      const std::uint32_t across = before[static_cast<std::size_t>(from)];
      if (across != kNoSite) least = std::min(least, across + most_along(blocks));
    };
    for (int k = 0; k < NearSiteOffset::kFarthest / kBlockSide + 1 && most_along(k) < least; ++k) {
      look(i - k, k);
      look(i + k, k);
    }
    bound[row[static_cast<std::size_t>(i - 1)]] = least;
  }
}

/// Whether it is clear from the blocks that hold obstacles that all sites are near. A sweep may
/// leave out what is not near then: it is on nobody's way to a site.
bool are_all_near(const BlockLayout& layout, const VoxelMask& obstacle, bool solid_outside,
                  int axes) {
  std::vector<std::uint32_t> bound(layout.block_count());
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    bound[slot] = is_empty(obstacle.block(slot)) ? kNoSite : 0;
  for (int axis = 0; axis < axes; ++axis)
    for_each_row(layout, axis,
                 [&](const BlockRow& row) { bound_along(row, solid_outside, bound); });
  constexpr std::uint32_t kMost = 4u * NearSiteOffset::kFarthest * NearSiteOffset::kFarthest;
  return std::all_of(bound.begin(), bound.end(), [](std::uint32_t b) { return b <= kMost; });
}

}  // namespace

NearestSites sweep_distances(const BlockLayout& layout, const VoxelMask& obstacle,
                             bool solid_outside, bool planar, double farthest) {
  assert(obstacle.is_of(layout));
  const int axes = planar ? 2 : 3;
  if (farthest <= NearSiteOffset::kFarthest || are_all_near(layout, obstacle, solid_outside, axes))
    return sweep<NearSiteOffset>(layout, obstacle, solid_outside, axes);
  return sweep<SiteOffset>(layout, obstacle, solid_outside, axes);
}

}  // namespace ridgeway::detail
