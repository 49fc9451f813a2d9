// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_field.hpp"

#include <atomic>

#include "line_update.hpp"

namespace ridgeway::detail {
namespace {

Put compared(std::uint32_t before, std::uint32_t now) {
  return now < before ? Put::kLowered : Put::kRaised;
}

/// What the sweep along x reads and writes.
struct AlongX {
  static constexpr int kAxis = 0;
  LiveField& field;

  std::uint32_t cost(VoxelId id) const { return field.esdf.obstacle.test(id) ? 0 : kNoSite; }
  int way(VoxelId id) const { return field.in_line[id]; }
  Put write(VoxelId id, VoxelId, int along, std::uint32_t) const {
    return put(id, static_cast<LineOffset>(along));
  }
  Put write_none(VoxelId id) const { return put(id, kNoWay); }

 private:
  Put put(VoxelId id, LineOffset offset) const {
    const LineOffset before = field.in_line[id];
    field.in_line.set(id, offset);
    return before == offset ? Put::kSame : compared(line_cost(before), line_cost(offset));
  }
};

/// And that along y.
struct AlongY {
  static constexpr int kAxis = 1;
  LiveField& field;

  std::uint32_t cost(VoxelId id) const { return line_cost(field.in_line[id]); }
  int way(VoxelId id) const {
    const PlaneOffset o = field.in_plane[id];
    return o.x == kNoWay ? kNoWay : o.y;
  }
  Put write(VoxelId id, VoxelId from, int along, std::uint32_t) const {
    const LineOffset x = from == kNoVoxel ? LineOffset{0} : field.in_line[from];
    return put(id, {x, static_cast<std::int16_t>(along)});
  }
  Put write_none(VoxelId id) const { return put(id, {kNoWay, 0}); }

 private:
  Put put(VoxelId id, const PlaneOffset& offset) const {
    const PlaneOffset before = field.in_plane[id];
    field.in_plane.set(id, offset);
    return before == offset ? Put::kSame : compared(plane_cost(before), plane_cost(offset));
  }
};

/// And that along z, whose results are the field.
struct AlongZ {
  static constexpr int kAxis = 2;
  LiveField& field;
  const bool is_cut_short;  // sites may be farther than the field holds

  std::uint32_t cost(VoxelId id) const { return plane_cost(field.in_plane[id]); }
  int way(VoxelId id) const {
    return field.esdf.squared[id] == kNoSite ? kNoWay : field.esdf.site[id].z;
  }
  Put write(VoxelId id, VoxelId from, int along, std::uint32_t squared) const {
    const PlaneOffset o = from == kNoVoxel ? PlaneOffset{} : field.in_plane[from];
    return put(id, {o.x, o.y, static_cast<std::int16_t>(along)}, squared);
  }
  Put write_none(VoxelId id) const {
    if (is_cut_short) std::atomic_ref(field.is_outgrown).store(true, std::memory_order_relaxed);
    return put(id, {}, kNoSite);
  }

 private:
  Put put(VoxelId id, const SiteOffset& site, std::uint32_t squared) const {
    const std::uint32_t before = field.esdf.squared[id];
    if (before == squared && field.esdf.site[id] == site) return Put::kSame;
    own_distances(field, id / kBlockVoxels);
    field.esdf.squared[id] = squared;
    field.esdf.site.set(id, site);
    return compared(before, squared);
  }
};

/// Where new blocks join lines that ended there, all that runs through them is swept again.
void mark_blocks(MarkedVoxels& marked, std::uint32_t first, std::uint32_t end) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t slot = first; slot < end; ++slot) {
    marked.voxels.block(slot).fill(~std::uint64_t{0});
    marked.lowered.block(slot).fill(~std::uint64_t{0});
    slots.push_back(slot);
  }
  marked.name(slots);
}

}  // namespace

void update_distances(LiveField& field) {
  const EsdfMap& esdf = field.esdf;
  const SweepReach reach = reach_of(field.farthest());
  const std::uint32_t blocks = esdf.layout.block_count();
  const std::uint32_t first_joined = field.solid_outside() ? blocks : field.first_new;
  const auto sweep = [&](const auto& along, MarkedVoxels& due, MarkedVoxels& changed) {
    mark_blocks(due, first_joined, blocks);
    changed.clear();
    sweep_again(esdf.layout, along, field.solid_outside(), reach, due, changed);
  };
  field.due.clear();
  for (const std::uint32_t slot : field.flipped.slots)
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t flips = field.flipped.voxels.block(slot)[z];
      field.due.voxels.block(slot)[z] = flips;
      field.due.lowered.block(slot)[z] = flips & esdf.obstacle.block(slot)[z];
    }
  field.due.name(field.flipped.slots);
  sweep(AlongX{field}, field.due, field.passed);
  sweep(AlongY{field}, field.passed, field.due);
  sweep(AlongZ{field, field.farthest() < esdf.max_distance / esdf.voxel_size}, field.due,
        field.changed);
  field.first_of_last = field.first_new;
  field.first_new = blocks;
}

}  // namespace ridgeway::detail
