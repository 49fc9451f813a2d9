// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/exploration/frontiers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

#include "block_masks.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway {
namespace {

bool is_same_block(const Roadmap& a, std::uint32_t slot_a, const Roadmap& b, std::uint32_t slot_b) {
  const VoxelState* const states_a = a.esdf.state.block(slot_a);
  const VoxelState* const states_b = b.esdf.state.block(slot_b);
  return states_a == states_b || std::memcmp(states_a, states_b, kBlockVoxels) == 0;
}

BlockIndex block_at(const BlockIndex& block, int direction) {
  const VoxelIndex& o = offset_of(direction);
  return block + BlockIndex{o.x, o.y, o.z};
}

/// The first of a set that is joined with others.
std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

/// Finds the blocks in another state than before; gives those whose frontier may be another: these,
/// and those across a face at which something became known or unknown.
std::vector<BlockIndex> Frontiers::find_changed(const Roadmap& now) {
  changed_.clear();
  const BlockLayout& layout = now.esdf.layout;
  const BlockLayout* const old_layout = roadmap_ ? &roadmap_->esdf.layout : nullptr;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    const BlockIndex& block = layout.block(slot);
    std::uint32_t before = BlockLayout::kNoBlock;
    if (old_layout != nullptr)  // mostly where it was
      before = slot < old_layout->block_count() && old_layout->block(slot) == block
                   ? slot
                   : old_layout->find_block(block);
    if (before == BlockLayout::kNoBlock || !is_same_block(*roadmap_, before, now, slot))
      changed_.push_back(block);
  }
  if (old_layout != nullptr)
    for (const BlockIndex& block : old_layout->blocks())
      if (layout.find_block(block) == BlockLayout::kNoBlock) changed_.push_back(block);
  std::sort(changed_.begin(), changed_.end());
  std::vector<BlockIndex> affected = changed_;
  closed_.clear();
  for (const BlockIndex& block : changed_) {
    if (roadmap_ && !detail::is_within(detail::mask_of(roadmap_->esdf, block, VoxelState::kFree),
                                       detail::mask_of(now.esdf, block, VoxelState::kFree)))
      closed_.push_back(block);
    detail::BlockMask before;
    before.fill(~std::uint64_t{0});
    if (roadmap_) before = detail::mask_of(roadmap_->esdf, block, VoxelState::kUnknown);
    const detail::BlockMask turned =
        detail::difference(before, detail::mask_of(now.esdf, block, VoxelState::kUnknown));
    for (const Direction face : kFaceDirections)
      if (detail::reaches(turned, face)) affected.push_back(block_at(block, face));
  }
  return affected;
}

void Frontiers::update(std::shared_ptr<const Roadmap> roadmap) {
  if (roadmap_ && roadmap && roadmap_->esdf.origin != roadmap->esdf.origin) {  // all has moved
    move_ignored(roadmap_->esdf.origin - roadmap->esdf.origin);
    roadmap_.reset();
    entries_.clear();
  }
  ++version_;
  if (!roadmap) return;
  std::vector<BlockIndex> affected = find_changed(*roadmap);
  roadmap_ = std::move(roadmap);
  for (const BlockIndex& block : std::exchange(stale_, {})) {
    affected.push_back(block);
    for (const Direction face : kFaceDirections) affected.push_back(block_at(block, face));
  }
  std::sort(affected.begin(), affected.end());
  affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  std::vector<Entry> made(affected.size());
  parallel_for_each_index(made.size(), [&](std::size_t i) { made[i] = entry_of(affected[i]); });
  for (std::size_t i = 0; i < made.size(); ++i) replace(affected[i], std::move(made[i]));
  for (const BlockIndex& block : affected) link(block);
  gather();
}

void Frontiers::ignore(std::span<const VoxelIndex> voxels) {
  for (const VoxelIndex& voxel : voxels) ignore(voxel);
}

void Frontiers::ignore(const VoxelIndex& voxel) {
  const BlockIndex block = block_of(voxel);
  const auto local = static_cast<std::size_t>(local_of(voxel));
  std::uint64_t& layer = ignored_[block][local / 64];
  if ((layer >> local % 64 & 1) != 0) return;
  layer |= std::uint64_t{1} << local % 64;
  ++ignored_count_;
  stale_.push_back(block);
}

void Frontiers::move_ignored(const VoxelIndex& by) {
  ignored_count_ = 0;
  for (const auto& [block, layers] : std::exchange(ignored_, {}))
    for (std::size_t z = 0; z < layers.size(); ++z)
      for (std::uint64_t bits = layers[z]; bits != 0; bits &= bits - 1)
        ignore(voxel_of(block, static_cast<int>(64 * z) + std::countr_zero(bits)) + by);
}

/// Those that are worth a look.
detail::BlockMask Frontiers::unknown_in(const BlockIndex& block) const {
  const EsdfMap& esdf = roadmap_->esdf;
  detail::BlockMask unknown = detail::both(
      detail::mask_of(esdf, block, VoxelState::kUnknown),
      detail::mask_within(block, within_.min - esdf.origin, within_.max - esdf.origin));
  if (const auto found = ignored_.find(block); found != ignored_.end())
    for (std::size_t z = 0; z < unknown.size(); ++z) unknown[z] &= ~found->second[z];
  return unknown;
}

/// The parts of the frontier in a block, by their first voxels.
std::vector<FrontierPart> Frontiers::parts_in(const BlockIndex& block, Entry& entry) const {
  const EsdfMap& esdf = roadmap_->esdf;
  std::vector<FrontierPart> parts;
  const detail::BlockMask free = detail::both(
      detail::mask_of(esdf, block, VoxelState::kFree),
      detail::mask_within(block, within_.min - esdf.origin, within_.max - esdf.origin));
  if (detail::is_empty(free)) return parts;
  std::array<detail::BlockMask, kFaceDirections.size()> looks_out;  // by face
  detail::BlockMask left{};
  const detail::BlockMask own = unknown_in(block);
  for (std::size_t f = 0; f < looks_out.size(); ++f) {
    looks_out[f] = detail::both(
        free,
        detail::beside(own, unknown_in(block_at(block, kFaceDirections[f])), kFaceDirections[f]));
    for (std::size_t z = 0; z < left.size(); ++z) left[z] |= looks_out[f][z];
  }
  while (!detail::is_empty(left)) {
    const detail::BlockMask piece = detail::first_piece(left);
    FrontierPart part;
    part.block = block;
    part.version = version_;
    for (std::size_t z = 0; z < left.size(); ++z)
      for (std::uint64_t bits = piece[z]; bits != 0; bits &= bits - 1) {
        const int local = static_cast<int>(64 * z) + std::countr_zero(bits);
        const VoxelIndex voxel = voxel_of(block, local);
        if (part.voxels == 0) part.first = voxel;
        ++part.voxels;
        part.centroid += centre_of(voxel, esdf.voxel_size);
        for (std::size_t f = 0; f < looks_out.size(); ++f)
          if ((looks_out[f][z] >> local % 64 & 1) != 0) {
            const VoxelIndex& o = offset_of(kFaceDirections[f]);
            part.normal += Eigen::Vector3d(o.x, o.y, o.z);
            part.targets.push_back(voxel + o);
          }
      }
    for (std::size_t z = 0; z < left.size(); ++z) left[z] &= ~piece[z];
    part.centroid /= static_cast<double>(part.voxels);
    part.normal /= static_cast<double>(part.targets.size());
    std::sort(part.targets.begin(), part.targets.end());
    part.targets.erase(std::unique(part.targets.begin(), part.targets.end()), part.targets.end());
    parts.push_back(std::move(part));
    entry.pieces.push_back(piece);
  }
  return parts;
}

/// Of a block as it is now; its parts are of the versions in which they were the same.
Frontiers::Entry Frontiers::entry_of(const BlockIndex& block) const {
  Entry entry;
  entry.version = version_;
  entry.made = parts_in(block, entry);
  const auto found = entries_.find(block);
  if (found != entries_.end())
    for (std::size_t i = 0; i < found->second.pieces.size(); ++i) {
      const FrontierPart& old = parts_[found->second.first + i];
      for (FrontierPart& part : entry.made)
        if (old.voxels == part.voxels && old.centroid == part.centroid &&
            old.targets == part.targets)
          part.version = old.version;
    }
  return entry;
}

void Frontiers::replace(const BlockIndex& block, Entry entry) {
  const auto found = entries_.find(block);
  const auto drop_links_to = [&](const Entry& gone) {
    for (int d = 0; d < kCentre; ++d)
      if (const auto before = entries_.find(block_at(block, d)); before != entries_.end())
        std::erase_if(before->second.links, [&](const Link& l) { return l.beyond == &gone; });
  };
  if (found != entries_.end()) drop_links_to(found->second);
  if (!entry.made.empty())
    entries_.insert_or_assign(block, std::move(entry));
  else if (found != entries_.end())
    entries_.erase(found);
}

/// Finds which parts of a block that was made again touch those of others: of blocks after it, and
/// of those before it that look at it from their side.
void Frontiers::link(const BlockIndex& block) {
  const auto own = entries_.find(block);
  if (own == entries_.end()) return;
  for (Direction d = 0; d < 27; ++d) {
    if (d == kCentre) continue;
    const auto found = entries_.find(block_at(block, d));
    if (found == entries_.end()) continue;
    if (d > kCentre)
      link(own->second, found->second, offset_of(d));
    else if (found->second.version != version_)  // else it does so itself
      link(found->second, own->second, VoxelIndex{} - offset_of(d));
  }
}

void Frontiers::link(Entry& entry, const Entry& beyond, const VoxelIndex& step) {
  for (std::size_t here = 0; here < entry.pieces.size(); ++here) {
    const detail::BlockMask touched = detail::touched_by(entry.pieces[here], step);
    for (std::size_t there = 0; there < beyond.pieces.size(); ++there)
      if (!detail::is_empty(detail::both(touched, beyond.pieces[there])))
        entry.links.push_back(
            {static_cast<std::uint32_t>(here), static_cast<std::uint32_t>(there), &beyond});
  }
}

void Frontiers::gather() {
  std::vector<FrontierPart> before = std::exchange(parts_, {});
  parts_.reserve(before.size() + 64);
  clusters_.clear();
  for (auto& [block, entry] : entries_) {
    const std::size_t first = std::exchange(entry.first, parts_.size());
    for (std::size_t i = 0; i < entry.pieces.size(); ++i)
      parts_.push_back(std::move(entry.made.empty() ? before[first + i] : entry.made[i]));
    entry.made.clear();
  }
  std::vector<std::size_t> parent(parts_.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const auto& [block, entry] : entries_)
    for (const Link& l : entry.links) {
      const std::size_t a = root_of(parent, entry.first + l.here);
      const std::size_t b = root_of(parent, l.beyond->first + l.there);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::size_t> number(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::size_t root = root_of(parent, i);
    if (root == i) {
      number[i] = clusters_.size();
      clusters_.emplace_back();
    }
    FrontierPart& part = parts_[i];
    part.cluster = number[root];
    FrontierCluster& cluster = clusters_[part.cluster];
    const auto voxels = static_cast<double>(part.voxels);
    cluster.voxels += part.voxels;
    cluster.centroid += voxels * part.centroid;
    cluster.normal += voxels * part.normal;
    cluster.parts.push_back(i);
  }
  for (FrontierCluster& cluster : clusters_) {
    cluster.centroid /= static_cast<double>(cluster.voxels);
    cluster.normal /= static_cast<double>(cluster.voxels);
  }
}

std::size_t Frontiers::voxels() const {
  std::size_t count = 0;
  for (const FrontierPart& part : parts_) count += part.voxels;
  return count;
}

}  // namespace ridgeway
