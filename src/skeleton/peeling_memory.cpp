// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "peeling_memory.hpp"

#include <utility>
#include <vector>

#include "level_peeling.hpp"
#include "ridgeway/common/parallel.hpp"
#include "simple_point.hpp"
#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway::detail {
namespace {

/// Peeling as turns: a voxel's level is its own, and by which turns voxels go that are not played
/// is as in PeelingMemory.
struct PeelingRule {
  const EsdfMap& esdf;
  const VoxelMask& traversable;
  const VoxelMask& keep;
  const VoxelMask& stayed;
  const VoxelMask& left;
  const FlatTable<VoxelId, Turn>& late;

  const VoxelMask& space() const { return traversable; }
  Turn first_turn(VoxelId id) const { return turn_at(esdf.squared[id], 0, sub_field(id)); }
  Turn later_turn(VoxelId, Turn) const { return kNever; }
  Turn base_turn(VoxelId id) const {
    if (!stayed.test(id)) return first_turn(id);
    return left.test(id) ? kNever : late.at(id, mixed(id));
  }
  bool may_go(VoxelId id, Cube27 cube, Turn) const { return !keep.test(id) && is_simple(cube); }
};

/// The members and all beside them.
template <typename Marked>
Marked dilated(const BlockLayout& layout, const Marked& marked) {
  Marked result{VoxelMask(layout), {}};
  std::vector<std::uint8_t> is_named(layout.block_count());
  for (const std::uint32_t slot : marked.slots)
    for (int d = 0; d < 27; ++d) {
      const std::uint32_t n = layout.neighbour_block(slot, d);
      if (n == BlockLayout::kNoBlock || is_named[n] != 0) continue;
      is_named[n] = 1;
      result.slots.push_back(n);
    }
  parallel_for_each_index(
      result.slots.size(),
      [&](std::size_t i) {
        const std::uint32_t slot = result.slots[i];
        result.voxels.block(slot) = CubeGather(layout, marked.voxels, slot).dilated();
      },
      32);
  std::erase_if(result.slots,
                [&](std::uint32_t slot) { return is_empty(result.voxels.block(slot)); });
  return result;
}

/// Voxels beside which one that did not go at its first turn is there for longer, or less long,
/// than their base turn supposes. `fresh`: those whose base turn is to be their first one; that of
/// before has not been forgotten yet.
template <typename Marked>
std::vector<VoxelId> disturbed(const BlockLayout& layout, const VoxelMask& traversable,
                               const VoxelMask& stayed, const Marked& fresh,
                               const PeelingRule& rule) {
  const auto look_at = [&](VoxelId id, std::vector<VoxelId>& ids) {
    const bool is_fresh = fresh.voxels.test(id);
    const Turn base = rule.base_turn(id), first = rule.first_turn(id);
    for (Cube27 cube = cube_around(layout, traversable, id) & kCells26; cube != 0;
         cube &= cube - 1) {
      const VoxelId n = layout.neighbour(id, std::countr_zero(cube));
      if (fresh.voxels.test(n) == is_fresh) continue;
      if (is_fresh ? rule.base_turn(n) > first : base > rule.first_turn(n)) ids.push_back(n);
    }
  };
  const Marked around = dilated(layout, fresh);
  std::vector<std::vector<VoxelId>> of_block(around.slots.size());
  parallel_for_each_index(
      around.slots.size(),
      [&](std::size_t i) {
        const std::uint32_t slot = around.slots[i];
        for_each_in(both(stayed.block(slot), around.voxels.block(slot)), slot,
                    [&](VoxelId id) { look_at(id, of_block[i]); });
      },
      32);
  std::vector<VoxelId> ids;
  for (const std::vector<VoxelId>& of_one : of_block)
    ids.insert(ids.end(), of_one.begin(), of_one.end());
  return ids;
}

}  // namespace

void PeelingMemory::change(const BlockLayout& layout, const VoxelMask& changed,
                           std::span<const std::uint32_t> slots) {
  for (VoxelMask* mask : {&changed_, &traversable_, &keep_, &left_, &stayed_}) mask->grow(layout);
  for (const std::uint32_t slot : slots)
    for (std::size_t z = 0; z < kBlockSide; ++z) changed_.block(slot)[z] |= changed.block(slot)[z];
}

const VoxelMask& PeelingMemory::peel(const EsdfMap& esdf, const VoxelMask& traversable,
                                     const VoxelMask& not_simple, const VoxelMask& keep,
                                     const Rest* rest) {
  if (knows_any_) {
    const Marked changed = take_over(esdf, traversable, keep, rest);
    peel_again(esdf, not_simple, changed);
    keep_levels(esdf, changed);
  } else {
    traversable_ = traversable;
    keep_ = keep;
    peel_all(esdf, not_simple);
    squared_ = esdf.squared.shared();
  }
  knows_any_ = true;
  changed_ = {};
  return left_;
}

/// In the memory of the map; other blocks have the levels that they had.
void PeelingMemory::keep_levels(const EsdfMap& esdf, const Marked& changed) {
  const auto before = static_cast<std::uint32_t>(squared_.size() / kBlockVoxels);
  squared_.follow(esdf.squared);
  for (const std::uint32_t slot : changed.slots)
    if (slot < before) squared_.share_block(esdf.squared, slot);
}

/// What is to be peeled from now on; the voxels of which anything is another.
PeelingMemory::Marked PeelingMemory::take_over(const EsdfMap& esdf, const VoxelMask& traversable,
                                               const VoxelMask& keep, const Rest* rest) {
  changed_.grow(esdf.layout);
  Marked changed{std::move(changed_), {}};
  const VoxelMask &old = traversable_, &old_keep = keep_;
  const std::vector<std::uint32_t> slots =
      rest != nullptr ? slots_of_any({rest->without, &changed.voxels})
                      : slots_of_any({&traversable, &old, &keep, &old_keep, &changed.voxels});
  for (const std::uint32_t slot : slots) {
    VoxelMask::Block& block = changed.voxels.block(slot);
    for_each_in(VoxelMask::Block(block), slot,
                [&](VoxelId id) {  // of some only the site is another
                  if (id < squared_.size() && esdf.squared[id] == squared_[id])
                    changed.voxels.reset(id);
                });
    const VoxelMask::Block kept = rest != nullptr ? rest->block(slot) : VoxelMask::Block{};
    const auto update = [&](VoxelMask& mask, const VoxelMask& given) {
      VoxelMask::Block now = given.block(slot);
      const VoxelMask::Block before = std::as_const(mask).block(slot);
      for (std::size_t z = 0; z < kBlockSide; ++z) {
        now[z] |= before[z] & kept[z];
        block[z] |= now[z] ^ before[z];
      }
      if (now != before) mask.block(slot) = now;
    };
    update(traversable_, traversable);
    update(keep_, keep);
    if (!is_empty(block)) changed.slots.push_back(slot);
  }
  return changed;
}

void PeelingMemory::peel_all(const EsdfMap& esdf, const VoxelMask& not_simple) {
  std::vector<LateVoxel> late;
  left_ = peel_levels(esdf, traversable_, not_simple, keep_, &late);
  left_count_ = left_.count();
  stayed_ = left_;
  for (const LateVoxel& voxel : late) {
    stayed_.set(voxel.id);
    late_.add(voxel.id, mixed(voxel.id), turn_at(voxel.level, voxel.round, sub_field(voxel.id)));
  }
}

void PeelingMemory::peel_again(const EsdfMap& esdf, const VoxelMask& not_simple,
                               const Marked& changed) {
  const BlockLayout& layout = esdf.layout;
  const VoxelMask &traversable = traversable_, &keep = keep_;
  // Those whose base turn is their first one from now on.
  const Marked fresh = dilated(layout, changed);
  const PeelingRule rule{esdf, traversable, keep, stayed_, left_, late_};
  const std::vector<VoxelId> to_play = disturbed(layout, traversable, stayed_, fresh, rule);
  for (const std::uint32_t slot : fresh.slots)
    for_each_in(both(stayed_.block(slot), fresh.voxels.block(slot)), slot,
                [&](VoxelId id) { forget(id); });
  scratch_.grow(layout);
  Replay<PeelingRule> replay(layout, rule, scratch_);
  for (const std::uint32_t slot : fresh.slots)
    for (const VoxelMask* mask : {&not_simple, &keep})
      for_each_in(both(mask->block(slot), fresh.voxels.block(slot)), slot,
                  [&](VoxelId id) { replay.play(id, 0); });
  for (const VoxelId id : to_play) replay.play(id, 0);
  replay.run();
  for (const auto& voxel : replay.played()) {
    const VoxelId id = voxel.id;
    if (stayed_.test(id)) forget(id);
    if (voxel.gone == rule.first_turn(id)) continue;
    stayed_.set(id);
    if (voxel.gone == kNever) {
      left_.set(id);
      ++left_count_;
    } else {
      late_.add(id, mixed(id), voxel.gone);
    }
  }
}

/// That a voxel stayed at its first turn, which it did.
void PeelingMemory::forget(VoxelId id) {
  stayed_.reset(id);
  if (left_.test(id))
    --left_count_;
  else
    late_.erase(id, mixed(id));
  left_.reset(id);
}

}  // namespace ridgeway::detail
