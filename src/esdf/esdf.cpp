// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/esdf.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "line_envelope.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/number_text.hpp"
#include "ridgeway/common/parallel.hpp"
#include "work_domain.hpp"

namespace ridgeway {
namespace {

constexpr SiteOffset kNoOffset{INT16_MIN, INT16_MIN, INT16_MIN};
static_assert(quarter_squared(kNoOffset) > quarter_squared(kFarthestSite + 1));

/// A straight row of blocks without a gap: the sweeps run along its 64 lines of voxels.
using BlockRow = std::vector<std::uint32_t>;

constexpr int forward_direction(int axis) { return axis == 0 ? 14 : axis == 1 ? 16 : 22; }

/// Slots that begin a row along an axis, that is, have no block before them.
std::vector<std::uint32_t> row_starts(const BlockLayout& layout, int axis) {
  std::vector<std::uint32_t> starts;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot)
    if (layout.neighbour_block(slot, opposite(forward_direction(axis))) == BlockLayout::kNoBlock)
      starts.push_back(slot);
  return starts;
}

BlockRow row_from(const BlockLayout& layout, std::uint32_t start, int axis) {
  BlockRow row;
  for (std::uint32_t slot = start; slot != BlockLayout::kNoBlock;
       slot = layout.neighbour_block(slot, forward_direction(axis)))
    row.push_back(slot);
  return row;
}

/// Line `line` (0..63) of voxels of a row along an axis.
struct Line {
  const BlockRow& row;
  const int axis;
  VoxelId base;    // place of the line's first voxel in a block
  VoxelId stride;  // from voxel to voxel

  Line(const BlockRow& blocks, int along, int line)
      : row(blocks), axis(along), stride(static_cast<VoxelId>(1 << (along * kBlockBits))) {
    const auto low = static_cast<VoxelId>(line & 7), high = static_cast<VoxelId>(line >> 3);
    base = axis == 0 ? low << 3 | high << 6 : axis == 1 ? low | high << 6 : low | high << 3;
  }

  /// Calls body(place, voxel) for the places first to last of the line.
  template <typename Body>
  void for_each_voxel(int first, int last, const Body& body) const {
    for (int i = first; i <= last;) {
      VoxelId id = row[static_cast<std::size_t>(i / kBlockSide)] * kBlockVoxels + base +
                   static_cast<VoxelId>(i % kBlockSide) * stride;
      const int end = std::min(last + 1, (i / kBlockSide + 1) * kBlockSide);
      for (; i < end; ++i, id += stride) body(i, id);
    }
  }

  /// The bits of a mask along the line in one of its blocks.
  std::uint64_t bits(const VoxelMask::Block& mask) const {
    const VoxelId low = base & 7, middle = base >> 3 & 7, high = base >> 6;
    if (axis == 0) return mask[high] >> (8 * middle) & 0xff;
    if (axis == 1)  // every eighth bit, gathered by a product
      return ((mask[high] >> low & 0x0101010101010101u) * 0x0102040810204080u) >> 56;
    std::uint64_t bits = 0;
    for (std::size_t z = 0; z < mask.size(); ++z) bits |= (mask[z] >> base & 1) << z;
    return bits;
  }
};

/// Calls run(first, last) for each run of ones in a row of bits.
template <typename Run>
void for_each_run(const std::vector<std::uint64_t>& words, const Run& run) {
  constexpr int kBits = 64;
  int first = -1;  // of the run that the words before end with
  for (std::size_t w = 0; w < words.size(); ++w) {
    const int begin = static_cast<int>(w) * kBits;
    for (int at = 0; at < kBits;) {
      const std::uint64_t rest = (first < 0 ? words[w] : ~words[w]) >> at;
      if (rest == 0) break;
      at += std::countr_zero(rest);
      if (first < 0) {
        first = begin + at;
      } else {
        run(first, begin + at - 1);
        first = -1;
      }
    }
  }
  if (first >= 0) run(first, static_cast<int>(words.size()) * kBits - 1);
}

class Sweeper {
 public:
  Sweeper(const BlockLayout& layout, const VoxelMask& obstacle, bool solid_outside,
          VoxelField<SiteOffset>& site)
      : layout_(layout), obstacle_(obstacle), solid_outside_(solid_outside), site_(site) {}

  void sweep(int axis) const {
    const std::vector<std::uint32_t> starts = row_starts(layout_, axis);
    parallel_for_each_index(starts.size(), [&](std::size_t i) {
      const BlockRow row = row_from(layout_, starts[i], axis);
      Scratch scratch(row.size());
      for (int line = 0; line < 64; ++line) sweep_line(Line(row, axis, line), scratch);
    });
  }

 private:
  struct Scratch {
    std::vector<std::uint64_t> free;  // a bit for each voxel of a line
    std::vector<SiteOffset> before;   // its sites before the sweep
    detail::LineEnvelope envelope;
    explicit Scratch(std::size_t blocks) : free(blocks / 8 + 1), before(blocks * kBlockSide) {}
  };

  /// An obstacle hides all that lies behind it, so each run between obstacles is swept alone.
  void sweep_line(const Line& line, Scratch& scratch) const {
    std::fill(scratch.free.begin(), scratch.free.end(), 0);
    for (std::size_t b = 0; b < line.row.size(); ++b)
      scratch.free[b / 8] |= (line.bits(obstacle_.block(line.row[b])) ^ 0xff) << (b % 8 * 8);
    for_each_run(scratch.free, [&](int first, int last) { sweep_run(line, first, last, scratch); });
  }

  void sweep_run(const Line& line, int first, int last, Scratch& scratch) const {
    detail::LineEnvelope& envelope = scratch.envelope;
    envelope.begin(first, last);
    if (first > 0 || solid_outside_) envelope.add({first - 1, 0});
    if (line.axis > 0)  // before the first sweep no voxel has a site
      line.for_each_voxel(first, last, [&](int i, VoxelId id) {
        const SiteOffset offset = scratch.before[static_cast<std::size_t>(i)] = site_[id];
        if (offset != kNoOffset) envelope.add({i, quarter_squared(offset)});
      });
    const int size = static_cast<int>(line.row.size()) * kBlockSide;
    if (last + 1 < size || solid_outside_) envelope.add({last + 1, 0});
    envelope.for_each_stretch([&](int begin, int end, int winner) {
      // A voxel alone with its own site keeps it.
      if (winner == begin && end == begin + 1 && winner >= first) return;
      SiteOffset offset{};
      if (winner >= first && winner <= last)
        offset = scratch.before[static_cast<std::size_t>(winner)];
      line.for_each_voxel(begin, end - 1, [&](int i, VoxelId id) {
        const auto along = static_cast<std::int16_t>(
            std::clamp(winner - i, -kFarthestSite - 1, kFarthestSite + 1));
        (line.axis == 0 ? offset.x : line.axis == 1 ? offset.y : offset.z) = along;
        site_[id] = offset;
      });
    });
  }

  const BlockLayout& layout_;
  const VoxelMask& obstacle_;
  const bool solid_outside_;
  VoxelField<SiteOffset>& site_;
};

VoxelMask find_obstacles(const BlockLayout& layout, const VoxelField<VoxelState>& state,
                         UnknownPolicy unknown) {
  const bool solid_unknown = unknown == UnknownPolicy::kObstacle;
  VoxelMask obstacle(layout);
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t slot) {
        const auto block = static_cast<std::uint32_t>(slot);
        const VoxelState* states = state.block(block);
        obstacle.block(block) = block_where([&](int v) {
          return (states[v] == VoxelState::kOccupied) |
                 ((states[v] == VoxelState::kUnknown) & solid_unknown);
        });
      },
      16);
  return obstacle;
}

/// Runs the three sweeps on a layout; voxels without a site get kNoOffset, obstacles anything.
VoxelField<SiteOffset> sweep_sites(const BlockLayout& layout, const VoxelMask& obstacle,
                                   bool solid_outside) {
  // Where all lines end at obstacles, the first sweep gives each free voxel a site.
  auto site = solid_outside ? VoxelField<SiteOffset>::unset(layout)
                            : VoxelField<SiteOffset>(layout, kNoOffset);
  const Sweeper sweeper(layout, obstacle, solid_outside, site);
  for (int axis = 0; axis < 3; ++axis) sweeper.sweep(axis);
  return site;
}

/// Carries a field over to another layout that holds all blocks it shares with the first.
template <typename Value>
VoxelField<Value> move_to_layout(const BlockLayout& from, const VoxelField<Value>& field,
                                 const BlockLayout& to, Value absent) {
  auto result = VoxelField<Value>::unset(to);
  parallel_for_each_index(
      to.block_count(),
      [&](std::size_t slot) {
        const auto target = static_cast<std::uint32_t>(slot);
        const std::uint32_t source = from.find_block(to.block(target));
        if (source != BlockLayout::kNoBlock) {
          std::copy_n(field.block(source), kBlockVoxels, result.block(target));
        } else {
          std::fill_n(result.block(target), kBlockVoxels, absent);
        }
      },
      64);
  return result;
}

/// Sites where unknown space is no obstacle: the sweeps must pass through blocks that the map has
/// not allocated, so they run on a larger layout.
VoxelField<SiteOffset> sweep_sites_through_unknown(const EsdfMap& map, double farthest) {
  std::vector<bool> occupied(map.layout.block_count());
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    occupied[slot] = map.obstacle.block(slot) != VoxelMask::Block{};
  const BlockLayout domain = detail::sweep_domain(map.layout, occupied, farthest);
  VoxelMask obstacle(domain);
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    obstacle.block(domain.find_block(map.layout.block(slot))) = map.obstacle.block(slot);
  return move_to_layout(domain, sweep_sites(domain, obstacle, false), map.layout, kNoOffset);
}

/// Squared distances from the offsets; too far or nothing at all becomes "no site".
void finish_distances(EsdfMap& map, double farthest) {
  map.squared = VoxelField<std::uint32_t>::unset(map.layout, Pages::kLarge);
  const double reach = std::min(farthest, static_cast<double>(kFarthestSite));
  const auto limit = static_cast<std::uint32_t>(squared_threshold(reach, 1.0) * (1.0 + 4e-9));
  parallel_for_each_index(
      map.layout.block_count(),
      [&](std::size_t index) {
        const auto slot = static_cast<std::uint32_t>(index);
        std::uint32_t* squared = map.squared.block(slot);
        SiteOffset* site = map.site.block(slot);
        for (const std::uint64_t layer : map.obstacle.block(slot))
          for (int v = 0; v < 64; ++v, ++squared, ++site) {
            const bool is_solid = layer >> v & 1;
            const std::uint32_t value = is_solid ? 0 : quarter_squared(*site);
            const bool is_far = value > limit;  // kNoOffset too
            if (is_solid || is_far) *site = {};
            *squared = is_far ? kNoSite : value;
          }
      },
      16);
}

}  // namespace

void EsdfConfig::validate() const {
  if (!(max_distance > 0.0))
    throw InputError("max_distance", "is " + number_text(max_distance),
                     "give a length above 0 metres, or leave it out for no limit");
}

EsdfMap compute_esdf(OccupancyMap map, const EsdfConfig& config) {
  config.validate();
  EsdfMap esdf;
  esdf.voxel_size = map.voxel_size;
  esdf.unknown = config.unknown;
  esdf.max_distance = config.max_distance;
  const double farthest = config.max_distance / map.voxel_size;
  const bool solid_unknown = config.unknown == UnknownPolicy::kObstacle;
  if (solid_unknown) {
    esdf.layout = std::move(map.layout);
    esdf.state = std::move(map.state);
  } else {
    esdf.layout = detail::with_neighbour_blocks(map.layout);
    esdf.state = move_to_layout(map.layout, map.state, esdf.layout, VoxelState::kUnknown);
  }
  esdf.obstacle = find_obstacles(esdf.layout, esdf.state, esdf.unknown);
  esdf.site = solid_unknown ? sweep_sites(esdf.layout, esdf.obstacle, true)
                            : sweep_sites_through_unknown(esdf, farthest);
  finish_distances(esdf, farthest);
  return esdf;
}

}  // namespace ridgeway
