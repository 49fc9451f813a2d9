// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/exploration/frontiers.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <set>
#include <unordered_set>
#include <utility>

#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway {
namespace {

constexpr std::array<Direction, 6> kFaces = {4, 10, 12, 14, 16, 22};

bool is_same_block(const Roadmap& a, std::uint32_t slot_a, const Roadmap& b, std::uint32_t slot_b) {
  const VoxelState* const states_a = a.esdf.state.block(slot_a);
  const VoxelState* const states_b = b.esdf.state.block(slot_b);
  return states_a == states_b || std::memcmp(states_a, states_b, kBlockVoxels) == 0;
}

constexpr std::uint64_t kFirstColumn = 0x0101010101010101;  // x = 0 of all rows of a layer
constexpr std::uint64_t kFirstRow = 0xff;                   // y = 0

/// A bit for each voxel of a block that has a state; all of them are unknown where there is none.
VoxelMask::Block mask_of(const EsdfMap& esdf, const BlockIndex& block, VoxelState state) {
  VoxelMask::Block mask{};
  const std::uint32_t slot = esdf.layout.find_block(block);
  if (slot == BlockLayout::kNoBlock) {
    if (state == VoxelState::kUnknown) mask.fill(~std::uint64_t{0});
    return mask;
  }
  const VoxelState* const states = esdf.state.block(slot);
  constexpr std::uint64_t kOnes = 0x0101010101010101;  // a row of eight states is one word
  static_assert(kBlockSide == 8);
  for (std::size_t row = 0; row < 64; ++row) {
    std::uint64_t word = 0;
    for (std::size_t x = 0; x < 8; ++x)
      word |= std::uint64_t{static_cast<std::uint8_t>(states[8 * row + x])} << 8 * x;
    word ^= kOnes * static_cast<std::uint8_t>(state);  // 0 where it is the state, else 1 to 3
    const std::uint64_t is_state = ~(word | word >> 1) & kOnes;
    mask[row / 8] |= is_state * 0x0102040810204080 >> 56 << 8 * (row % 8);  // eight bits in a byte
  }
  return mask;
}

/// A bit for each free voxel of a block with an unknown one across a face.
VoxelMask::Block free_beside_unknown(const EsdfMap& esdf, const BlockIndex& block) {
  const VoxelMask::Block free = mask_of(esdf, block, VoxelState::kFree);
  VoxelMask::Block found{};
  if (std::all_of(free.begin(), free.end(), [](std::uint64_t layer) { return layer == 0; }))
    return found;
  const auto unknown = [&](int x, int y, int z) {
    return mask_of(esdf, block + BlockIndex{x, y, z}, VoxelState::kUnknown);
  };
  const VoxelMask::Block own = unknown(0, 0, 0), below = unknown(0, 0, -1),
                         above = unknown(0, 0, 1), left = unknown(-1, 0, 0),
                         right = unknown(1, 0, 0), front = unknown(0, -1, 0),
                         back = unknown(0, 1, 0);
  constexpr std::size_t kTop = kBlockSide - 1;
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t u = own[z];
    const std::uint64_t beside =
        (z == 0 ? below[kTop] : own[z - 1]) | (z == kTop ? above[0] : own[z + 1]) |
        (u << 1 & ~kFirstColumn) | (left[z] >> 7 & kFirstColumn) |          // unknown at x - 1
        (u >> 1 & ~(kFirstColumn << 7)) | (right[z] & kFirstColumn) << 7 |  // at x + 1
        u << 8 | front[z] >> 56 | u >> 8 | (back[z] & kFirstRow) << 56;     // at y - 1, y + 1
    found[z] = free[z] & beside;
  }
  return found;
}

/// The first of a set that is joined with others.
std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

void Frontiers::find_changed(const Roadmap& now) {
  changed_.clear();
  const BlockLayout& layout = now.esdf.layout;
  for (std::uint32_t slot = 0; slot < layout.block_count(); ++slot) {
    const BlockIndex& block = layout.block(slot);
    const std::uint32_t before =
        roadmap_ ? roadmap_->esdf.layout.find_block(block) : BlockLayout::kNoBlock;
    if (before == BlockLayout::kNoBlock || !is_same_block(*roadmap_, before, now, slot))
      changed_.push_back(block);
  }
  if (roadmap_)
    for (const BlockIndex& block : roadmap_->esdf.layout.blocks())
      if (layout.find_block(block) == BlockLayout::kNoBlock) changed_.push_back(block);
  std::sort(changed_.begin(), changed_.end());
}

void Frontiers::update(std::shared_ptr<const Roadmap> roadmap) {
  if (roadmap_ && roadmap && roadmap_->esdf.origin != roadmap->esdf.origin) {  // all has moved
    roadmap_.reset();
    entries_.clear();
  }
  ++version_;
  if (!roadmap) return;
  find_changed(*roadmap);
  roadmap_ = std::move(roadmap);
  std::set<BlockIndex> remade;
  const auto add_with_neighbours = [&](const BlockIndex& block) {
    remade.insert(block);
    for (const Direction face : kFaces) {
      const VoxelIndex& o = offset_of(face);
      remade.insert(block + BlockIndex{o.x, o.y, o.z});
    }
  };
  for (const BlockIndex& block : changed_) add_with_neighbours(block);
  for (const BlockIndex& block : std::exchange(stale_, {})) add_with_neighbours(block);
  for (const BlockIndex& block : remade) remake(block);
  std::unordered_set<BlockIndex, BlockHash> linked;  // each by itself: in any order
  for (const BlockIndex& block : remade)
    for (int d = 0; d < 27; ++d) {
      const VoxelIndex& o = offset_of(d);
      linked.insert(block + BlockIndex{o.x, o.y, o.z});
    }
  for (const BlockIndex& block : linked) link(block);
  gather();
}

void Frontiers::ignore(std::span<const VoxelIndex> voxels) {
  for (const VoxelIndex& voxel : voxels) {
    const BlockIndex block = block_of(voxel);
    const auto local = static_cast<std::size_t>(local_of(voxel));
    std::uint64_t& layer = ignored_[block][local / 64];
    if ((layer >> local % 64 & 1) != 0) continue;
    layer |= std::uint64_t{1} << local % 64;
    ++ignored_count_;
    stale_.push_back(block);
  }
}

bool Frontiers::is_unknown(const VoxelIndex& voxel, VoxelId id) const {
  if (id != kNoVoxel && roadmap_->esdf.state[id] != VoxelState::kUnknown) return false;
  if (!within_.contains(voxel + roadmap_->esdf.origin)) return false;
  if (ignored_.empty()) return true;
  const auto found = ignored_.find(block_of(voxel));
  if (found == ignored_.end()) return true;
  const auto local = static_cast<std::size_t>(local_of(voxel));
  return (found->second[local / 64] >> local % 64 & 1) == 0;
}

bool Frontiers::is_frontier(VoxelId id, const VoxelIndex& voxel, Eigen::Vector3d& normal,
                            std::vector<VoxelIndex>* targets) const {
  bool is_one = false;
  for (const Direction face : kFaces) {
    const VoxelIndex& o = offset_of(face);
    const VoxelIndex beyond = voxel + o;
    if (!is_unknown(beyond, roadmap_->esdf.layout.neighbour(id, face))) continue;
    is_one = true;
    normal += Eigen::Vector3d(o.x, o.y, o.z);
    if (targets != nullptr) targets->push_back(beyond);
  }
  return is_one;
}

void Frontiers::remake(const BlockIndex& block) {
  std::vector<FrontierPart> before;
  if (const auto found = entries_.find(block); found != entries_.end()) {
    before = std::move(found->second.parts);
    entries_.erase(found);
  }
  const EsdfMap& esdf = roadmap_->esdf;
  const std::uint32_t slot = esdf.layout.find_block(block);
  if (slot == BlockLayout::kNoBlock) return;
  const VoxelMask::Block candidates = free_beside_unknown(esdf, block);  // within bounds or not
  Entry entry;
  std::vector<int> members;
  Eigen::Vector3d unused = Eigen::Vector3d::Zero();
  for (int local = 0; local < kBlockVoxels; ++local) {
    if ((candidates[static_cast<std::size_t>(local) / 64] >> local % 64 & 1) == 0) continue;
    const VoxelIndex voxel = voxel_of(block, local);
    if (!within_.contains(voxel + esdf.origin)) continue;
    if (is_frontier(slot * kBlockVoxels + static_cast<VoxelId>(local), voxel, unused, nullptr))
      members.push_back(local);
  }
  if (members.empty()) return;
  constexpr std::uint8_t kWaiting = 255;  // no label: there are 64 parts of a block at most
  for (const int local : members) entry.labels[static_cast<std::size_t>(local)] = kWaiting;
  std::vector<int> stack;
  for (const int first : members) {
    if (entry.labels[static_cast<std::size_t>(first)] != kWaiting) continue;
    FrontierPart part;
    part.block = block;
    part.first = voxel_of(block, first);
    part.version = version_;
    const auto label = static_cast<std::uint8_t>(entry.parts.size() + 1);
    stack.push_back(first);
    entry.labels[static_cast<std::size_t>(first)] = label;
    while (!stack.empty()) {
      const int local = stack.back();
      stack.pop_back();
      const VoxelIndex voxel = voxel_of(block, local);
      ++part.voxels;
      part.centroid += centre_of(voxel, esdf.voxel_size);
      is_frontier(slot * kBlockVoxels + static_cast<VoxelId>(local), voxel, part.normal,
                  &part.targets);
      for (int d = 0; d < 27; ++d) {
        const VoxelIndex next = voxel + offset_of(d);
        if (block_of(next) != block) continue;
        std::uint8_t& at = entry.labels[static_cast<std::size_t>(local_of(next))];
        if (at != kWaiting) continue;
        at = label;
        stack.push_back(local_of(next));
      }
    }
    part.centroid /= static_cast<double>(part.voxels);
    part.normal /= static_cast<double>(std::max<std::size_t>(part.targets.size(), 1));
    std::sort(part.targets.begin(), part.targets.end());
    part.targets.erase(std::unique(part.targets.begin(), part.targets.end()), part.targets.end());
    for (const FrontierPart& old : before)
      if (old.voxels == part.voxels && old.centroid == part.centroid && old.targets == part.targets)
        part.version = old.version;  // it is the same
    entry.parts.push_back(std::move(part));
  }
  entries_.emplace(block, std::move(entry));
}

void Frontiers::link(const BlockIndex& block) {
  const auto own = entries_.find(block);
  if (own == entries_.end()) return;
  Entry& entry = own->second;
  entry.pairs.clear();
  entry.partners.clear();
  std::array<const Entry*, 27> beside{};  // by direction, those that are greater than this
  bool has_any = false;
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex& o = offset_of(d);
    const BlockIndex other = block + BlockIndex{o.x, o.y, o.z};
    if (!(block < other)) continue;
    if (const auto found = entries_.find(other); found != entries_.end()) {
      beside[static_cast<std::size_t>(d)] = &found->second;
      has_any = true;
    }
  }
  if (!has_any) return;
  std::set<std::array<std::uint32_t, 3>> links;  // direction, part here, part there
  for (int local = 0; local < kBlockVoxels; ++local) {
    const std::uint8_t label = entry.labels[static_cast<std::size_t>(local)];
    if (label == 0) continue;
    const VoxelIndex in_block = voxel_of(BlockIndex{}, local);
    for (int e = 0; e < 27; ++e) {
      const VoxelIndex next = in_block + offset_of(e);
      const BlockIndex step = block_of(next);
      const int d = direction_of({step.x, step.y, step.z});
      const Entry* const other = beside[static_cast<std::size_t>(d)];
      if (other == nullptr) continue;
      const std::uint8_t there = other->labels[static_cast<std::size_t>(local_of(next))];
      if (there != 0) links.insert({static_cast<std::uint32_t>(d), label - 1u, there - 1u});
    }
  }
  for (const auto& [d, here, there] : links) {
    const VoxelIndex& o = offset_of(static_cast<int>(d));
    entry.pairs.push_back({here, there});
    entry.partners.push_back(block + BlockIndex{o.x, o.y, o.z});
  }
}

void Frontiers::gather() {
  parts_.clear();
  clusters_.clear();
  std::map<BlockIndex, std::size_t> first;
  for (const auto& [block, entry] : entries_) {
    first[block] = parts_.size();
    parts_.insert(parts_.end(), entry.parts.begin(), entry.parts.end());
  }
  std::vector<std::size_t> parent(parts_.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const auto& [block, entry] : entries_)
    for (std::size_t i = 0; i < entry.pairs.size(); ++i) {
      const std::size_t a = root_of(parent, first[block] + entry.pairs[i][0]);
      const std::size_t b = root_of(parent, first[entry.partners[i]] + entry.pairs[i][1]);
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
