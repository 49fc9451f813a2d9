// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_ridges.hpp"

#include <utility>
#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "skeleton/block_ridges.hpp"
#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

/// Members of a block on the side, edge or corner towards a direction; all for the centre.
bool has_member_towards(const VoxelMask::Block& block, const VoxelIndex& direction) {
  constexpr std::uint64_t kLowX = 0x0101010101010101u, kLowY = 0xffu, kAll = ~std::uint64_t{0};
  const auto side = [](int sign, std::uint64_t low, int shift) {
    return sign == 0 ? kAll : sign < 0 ? low : low << shift;
  };
  const std::uint64_t cells = side(direction.x, kLowX, 7) & side(direction.y, kLowY, 56);
  std::uint64_t any = 0;
  for (std::size_t z = 0; z < kBlockSide; ++z)
    if (direction.z == 0 || (direction.z < 0 ? z == 0 : z == kBlockSide - 1)) any |= block[z];
  return (any & cells) != 0;
}

/// Makes some blocks of a mask again, marks what is new, and keeps count of its members.
template <typename BlockOf>
void remake(const std::vector<std::uint32_t>& slots, const BlockOf& block_of_slot, VoxelMask& mask,
            MarkedVoxels& changed, std::size_t& count) {
  changed.clear();
  std::vector<std::uint8_t> is_new(slots.size());
  parallel_for_each_index(slots.size(), [&](std::size_t i) {
    const std::uint32_t slot = slots[i];
    const VoxelMask::Block block = block_of_slot(slot);
    if (block == mask.block(slot)) return;
    for (std::size_t z = 0; z < kBlockSide; ++z)
      changed.voxels.block(slot)[z] = block[z] ^ mask.block(slot)[z];
    mask.block(slot) = block;
    is_new[i] = 1;
  });
  std::vector<std::uint32_t> named;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (is_new[i] == 0) continue;
    named.push_back(slots[i]);
    VoxelMask::Block came = changed.voxels.block(slots[i]);
    const std::size_t all = count_of(came);
    for (std::size_t z = 0; z < kBlockSide; ++z) came[z] &= mask.block(slots[i])[z];
    count += 2 * count_of(came) - all;  // what came less what went
  }
  changed.name(named);
}

}  // namespace

std::vector<std::uint32_t> blocks_around(const BlockLayout& layout, const MarkedVoxels& marked) {
  MarkedVoxels around;
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t slot : marked.slots)
    for (int d = 0; d < 27; ++d)
      if (const std::uint32_t n = layout.neighbour_block(slot, d);
          n != BlockLayout::kNoBlock && has_member_towards(marked.voxels.block(slot), offset_of(d)))
        slots.push_back(n);
  around.name(slots);
  return std::move(around.slots);
}

void update_traversable(LiveRidges& ridges, const LiveField& field) {
  const EsdfMap& esdf = field.esdf;
  ridges.traversable.grow(esdf.layout);
  ridges.changed_space.grow_voxels(esdf.layout);
  remake(
      field.changed.slots,
      [&](std::uint32_t slot) { return traversable_in_block(esdf, ridges.radius, slot); },
      ridges.traversable, ridges.changed_space, ridges.traversable_count);
}

void update_edges(LiveRidges& ridges, const LiveField& field) {
  const EsdfMap& esdf = field.esdf;
  for (VoxelMask* mask : {&ridges.gvd, &ridges.thick_edges, &ridges.edges}) mask->grow(esdf.layout);
  for (MarkedVoxels* marked : {&ridges.changed_gvd, &ridges.changed_thick})
    marked->grow_voxels(esdf.layout);
  remake(
      blocks_around(esdf.layout, field.changed),
      [&](std::uint32_t slot) {
        return gvd_in_block(esdf, ridges.traversable, ridges.config, slot);
      },
      ridges.gvd, ridges.changed_gvd, ridges.gvd_count);
  remake(
      blocks_around(esdf.layout, ridges.changed_gvd),
      [&](std::uint32_t slot) { return edges_in_block(esdf.layout, ridges.gvd, slot); },
      ridges.thick_edges, ridges.changed_thick, ridges.thick_count);
  ridges.thinning.thin(esdf.layout, ridges.thick_edges, ridges.changed_thick.voxels,
                       ridges.changed_thick.slots, ridges.edges);
}

}  // namespace ridgeway::detail
