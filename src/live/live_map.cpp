// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// The map in a live field: its blocks and states.
#include <algorithm>

#include "live_field.hpp"
#include "mapping/memory_limit.hpp"
#include "shared_memory.hpp"

namespace ridgeway::detail {
namespace {

void set_state(LiveField& field, VoxelId id, VoxelState state) noexcept {
  VoxelState& current = field.esdf.state[id];
  std::uint16_t& known = field.known[id / kBlockVoxels];
  known = static_cast<std::uint16_t>(known + (state != VoxelState::kUnknown) -
                                     (current != VoxelState::kUnknown));
  current = state;
}

void set_obstacle(LiveField& field, VoxelId id, VoxelState state) {
  if (is_obstacle(state, field.esdf.unknown))
    field.esdf.obstacle.set(id);
  else
    field.esdf.obstacle.reset(id);
}

/// Blocks that the layout lacks.
std::vector<BlockIndex> missing_blocks(const LiveField& field,
                                       std::span<const VoxelChange> changes) {
  std::vector<BlockIndex> missing;
  VoxelFinder finder(field.esdf.layout);
  for (const VoxelChange& change : changes) {
    if (change.state == VoxelState::kUnknown) continue;
    const BlockIndex block = block_of(change.voxel - field.esdf.origin);
    if (finder.find_block(block) != BlockLayout::kNoBlock) continue;
    if (missing.empty() || missing.back() != block) missing.push_back(block);
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  return missing;
}

}  // namespace

LiveField::LiveField(double voxel_size, const VoxelIndex& origin, const EsdfConfig& config,
                     bool near_only) {
  if (near_only) {
    esdf.site = SiteField(SiteField::Near{});
    in_line = decltype(in_line)(decltype(in_line)::Near{});
    in_plane = decltype(in_plane)(decltype(in_plane)::Near{});
  }
  config.validate();
  esdf.voxel_size = voxel_size;
  esdf.origin = origin;
  esdf.unknown = config.unknown;
  esdf.max_distance = config.max_distance;
  esdf.limits = limits_in_local(esdf, config.limits);
  add_blocks(*this, {});
}

void add_blocks(LiveField& field, std::span<const BlockIndex> blocks) {
  EsdfMap& esdf = field.esdf;
  const std::uint32_t before = esdf.layout.block_count();
  esdf.layout.add(blocks);
  const bool solid = field.solid_outside();
  field.known.resize(esdf.layout.block_count());
  field.owns_state.resize(esdf.layout.block_count(), 1);
  field.owns_distances.resize(esdf.layout.block_count(), 1);
  esdf.state.grow(esdf.layout, VoxelState::kUnknown);
  esdf.obstacle.grow(esdf.layout);
  if (solid)
    for (std::uint32_t slot = before; slot < esdf.layout.block_count(); ++slot)
      esdf.obstacle.block(slot).fill(~std::uint64_t{0});
  field.in_line.grow(esdf.layout, solid ? LineOffset{0} : kNoWay);
  field.in_plane.grow(esdf.layout, {solid ? std::int16_t{0} : kNoWay, 0});
  esdf.squared.grow(esdf.layout, solid ? 0 : kNoSite);
  esdf.site.grow(esdf.layout);
  field.flipped.grow_voxels(esdf.layout);
  for (MarkedVoxels* marked : {&field.changed, &field.due, &field.passed})
    marked->grow(esdf.layout);
}

void own_state(LiveField& field, std::uint32_t slot) {
  if (field.owns_state[slot] != 0) return;
  field.esdf.state.own_block(slot);
  field.owns_state[slot] = 1;
}

void own_distances(LiveField& field, std::uint32_t slot) {
  if (field.owns_distances[slot] != 0) return;
  field.esdf.squared.own_block(slot);
  field.esdf.site.own_block(slot);
  field.owns_distances[slot] = 1;
}

EsdfMap share(LiveField& field) {
  EsdfMap same = in_same_memory(field.esdf);
  std::fill(field.owns_state.begin(), field.owns_state.end(), 0);
  std::fill(field.owns_distances.begin(), field.owns_distances.end(), 0);
  return same;
}

void apply_changes(LiveField& field, std::span<const VoxelChange> changes) {
  field.before.clear();
  field.before.reserve(changes.size());
  field.flipped.clear();
  if (const std::vector<BlockIndex> missing = missing_blocks(field, changes); !missing.empty()) {
    require_memory_for_blocks(static_cast<double>(missing.size()), kPipelineBytesPerVoxel, "map");
    add_blocks(field, missing);
  }
  VoxelFinder finder(field.esdf.layout);
  std::vector<std::uint32_t> slots;
  for (const VoxelChange& change : changes) {
    const VoxelId id = finder.find(change.voxel - field.esdf.origin);
    if (id == kNoVoxel || field.esdf.state[id] == change.state) continue;
    own_state(field, id / kBlockVoxels);
    const VoxelState before = field.esdf.state[id];
    field.before.emplace_back(id, before);
    set_state(field, id, change.state);
    set_obstacle(field, id, change.state);
    if (is_obstacle(before, field.esdf.unknown) == is_obstacle(change.state, field.esdf.unknown))
      continue;
    const std::uint32_t slot = id / kBlockVoxels;
    if (slots.empty() || slots.back() != slot) slots.push_back(slot);
    field.flipped.voxels.block(slot)[id / 64 % kBlockSide] ^= 1ull << id % 64;  // twice: not at all
  }
  field.flipped.name(slots);
}

void undo_changes(LiveField& field) noexcept {
  for (auto change = field.before.rbegin(); change != field.before.rend(); ++change)
    set_state(field, change->first, change->second);
  field.before.clear();
}

void drop_distances(LiveField& field) {
  field.in_line = {};
  field.in_plane = {};
  field.esdf.squared = {};
  field.esdf.site = {};
}

OccupancyMap map_of(const LiveField& field) {
  OccupancyMap map;
  map.voxel_size = field.esdf.voxel_size;
  map.origin = field.esdf.origin;
  std::vector<BlockIndex> blocks;
  for (std::uint32_t slot = 0; slot < field.known.size(); ++slot)
    if (field.known[slot] > 0) blocks.push_back(field.esdf.layout.block(slot));
  map.layout = BlockLayout(std::move(blocks));
  map.state = VoxelField<VoxelState>::unset(map.layout);
  for (std::uint32_t slot = 0; slot < map.layout.block_count(); ++slot)
    std::copy_n(field.esdf.state.block(field.esdf.layout.find_block(map.layout.block(slot))),
                kBlockVoxels, map.state.block(slot));
  return map;
}

}  // namespace ridgeway::detail
