// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "corner_regions.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <optional>

#include "attach_way.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace detail {
namespace {

constexpr Part kNewPart = 0xffff;  // not looked at yet, or of nothing

/// What holds for two things of which each has a part.
Part of_both(Part a, Part b) {
  if (a == kNewPart) return b;
  return b == kNewPart || a == b ? a : kNoPart;
}

/// Ways over the attach field, and the connected parts of the graph that they lead to.
class Ways {
 public:
  explicit Ways(const Roadmap& roadmap)
      : roadmap_(roadmap),
        layout_(roadmap.esdf.layout),
        next_(roadmap.attach.next),
        parts_(connected_components(roadmap.graph)) {}

  /// The part that all ways end at, kNewPart where there is no way; nothing where they end at
  /// several.
  std::optional<Part> only_part() const {
    std::atomic<Part> only = kNewPart;
    std::atomic<bool> are_several = false;
    parallel_for_each_index(
        layout_.block_count(),
        [&](std::size_t slot) {
          for_each_end(static_cast<std::uint32_t>(slot), [&](VoxelId end) {
            const Part part = part_at(end);
            Part before = kNewPart;
            if (!only.compare_exchange_strong(before, part) && before != part) are_several = true;
          });
        },
        64);
    if (are_several) return std::nullopt;
    return only.load();
  }

  /// By slot, the part that the ways of a block's traversable voxels lead to. Every voxel is walked
  /// over about once: a thread stops where it, or another, has been.
  std::vector<Part> parts_of_blocks() const {
    VoxelField<Part> known(layout_, kNewPart);
    std::vector<Part> of_block(layout_.block_count(), kNewPart);
    parallel_for_each_index(
        of_block.size(),
        [&](std::size_t slot) {
          std::vector<VoxelId> way;
          const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
          for (VoxelId start = first; start < first + kBlockVoxels; ++start)
            if (next_[start] != AttachField::kNotTraversable)
              of_block[slot] = of_both(of_block[slot], part_of(start, known, way));
        },
        16);
    return of_block;
  }

 private:
  template <typename Visit>
  void for_each_end(std::uint32_t slot, const Visit& visit) const {
    const Direction* const first = next_.block(slot);
    const Direction* const end = first + kBlockVoxels;
    for (const Direction* at = first; at != end; ++at) {
      at = static_cast<const Direction*>(
          std::memchr(at, AttachField::kHere, static_cast<std::size_t>(end - at)));
      if (at == nullptr) return;
      visit(slot * kBlockVoxels + static_cast<VoxelId>(at - first));
    }
  }

  Part part_at(VoxelId end) const {
    const VertexId vertex = vertex_at(roadmap_.graph, layout_.index_of(end));
    const std::uint32_t label = vertex == kNoVertex ? kNoPart : parts_.label[number(vertex)];
    return static_cast<Part>(std::min<std::uint32_t>(label, kNoPart));
  }

  /// `way`: memory to work with.
  Part part_of(VoxelId id, VoxelField<Part>& known, std::vector<VoxelId>& way) const {
    way.clear();
    const auto known_at = [&](VoxelId at) { return std::atomic_ref(known[at]); };
    Part part = known_at(id).load(std::memory_order_relaxed);
    while (part == kNewPart && next_[id] != AttachField::kHere) {
      way.push_back(id);
      id = layout_.neighbour(id, next_[id]);
      part = known_at(id).load(std::memory_order_relaxed);
    }
    if (part == kNewPart) {
      way.push_back(id);
      part = part_at(id);
    }
    for (const VoxelId passed : way) known_at(passed).store(part, std::memory_order_relaxed);
    return part;
  }

  const Roadmap& roadmap_;
  const BlockLayout& layout_;
  const VoxelField<Direction>& next_;
  const GraphComponents parts_;
};

}  // namespace

std::vector<Part> parts_of_regions(const Roadmap& roadmap,
                                   const std::vector<std::uint32_t>& region_of_block,
                                   std::size_t regions) {
  const Ways ways(roadmap);
  if (const std::optional<Part> only = ways.only_part()) return std::vector<Part>(regions, *only);
  const std::vector<Part> of_block = ways.parts_of_blocks();
  std::vector<Part> result(regions, kNewPart);
  for (std::size_t slot = 0; slot < of_block.size(); ++slot) {
    Part& of_region = result[region_of_block[slot]];
    of_region = of_both(of_region, of_block[slot]);
  }
  return result;
}

}  // namespace detail

BlockRegions number_regions(const BlockLayout& layout) {
  BlockRegions regions;
  std::map<BlockIndex, std::uint32_t> numbers;
  regions.region_of_block.resize(layout.block_count());
  for (std::uint32_t rank = 0; rank < layout.block_count(); ++rank) {
    const std::uint32_t slot = layout.slot_at(rank);
    const BlockIndex& block = layout.block(slot);
    const BlockIndex region{block.x >> 1, block.y >> 1, block.z >> 1};
    const auto [place, is_new] = numbers.try_emplace(region, regions.count);
    regions.count += is_new ? 1 : 0;
    regions.region_of_block[slot] = place->second;
  }
  return regions;
}

}  // namespace ridgeway
