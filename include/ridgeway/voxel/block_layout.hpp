// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ridgeway/voxel/index.hpp"
#include "ridgeway/voxel/neighbourhood.hpp"

namespace ridgeway {
namespace detail {

/// One value for every slot, zero at first, in pages of 64. Copies share pages until one of them is
/// written to, and pages that nobody has written to are all one and the same: what a copy costs is
/// a pointer and a byte a page, what an empty array costs, too.
template <typename Value>
class SharedPages {
 public:
  static constexpr std::uint32_t kPerPage = 64;

  SharedPages() = default;
  SharedPages(const SharedPages& other)
      : pages_(other.pages_), states_(other.states_.size(), kShared), count_(other.count_) {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      if (!is_there(i)) continue;
      pages_[i]->owners.fetch_add(1, std::memory_order_relaxed);
      std::atomic_ref(other.states_[i]).store(kShared, std::memory_order_relaxed);
    }
  }
  SharedPages(SharedPages&& other) noexcept
      : pages_(std::exchange(other.pages_, {})),
        states_(std::exchange(other.states_, {})),
        count_(std::exchange(other.count_, 0)) {}
  SharedPages& operator=(const SharedPages& other) { return *this = SharedPages(other); }
  SharedPages& operator=(SharedPages&& other) noexcept {
    SharedPages taken(std::move(other));  // which is left empty
    pages_.swap(taken.pages_);
    states_.swap(taken.states_);
    std::swap(count_, taken.count_);
    return *this;
  }
  ~SharedPages() {
    for (Page* page : pages_) release(page);
  }

  /// So many slots from now on, no fewer than before.
  void grow(std::uint32_t count) {
    const std::size_t pages = (std::size_t{count} + kPerPage - 1) / kPerPage;
    if (pages > pages_.capacity()) pages_.reserve(std::max(pages, 2 * pages_.size()));
    states_.resize(pages, kShared);
    pages_.resize(pages, nobodys());
    count_ = count;
  }
  /// All zero again, at the same size.
  void clear() noexcept {
    for (std::size_t i = 0; i < pages_.size(); ++i) release(std::exchange(pages_[i], nobodys()));
    std::fill(states_.begin(), states_.end(), std::uint8_t{kShared});
  }
  std::uint32_t size() const { return count_; }
  std::size_t page_count() const { return pages_.size(); }
  /// Whether anybody has written to a page; else its values are zero.
  bool is_there(std::size_t page) const { return pages_[page] != nobodys(); }
  std::size_t memory_bytes() const {
    std::size_t bytes = pages_.capacity() * sizeof(void*) + states_.capacity();
    for (std::size_t page = 0; page < pages_.size(); ++page)
      if (is_there(page)) bytes += sizeof(Page);
    return bytes;
  }

  const Value& operator[](std::uint32_t slot) const {
    return pages_[slot / kPerPage]->values[slot % kPerPage];
  }
  /// To be written to; for any thread, while none reads others of the same page.
  Value& own(std::uint32_t slot) {
    const std::uint32_t page = slot / kPerPage;
    if (std::atomic_ref(states_[page]).load(std::memory_order_acquire) != kOwn) own_page(page);
    return pages_[page]->values[slot % kPerPage];
  }

 private:
  struct Page {
    std::array<Value, kPerPage> values{};
    std::atomic<std::uint32_t> owners = 1;
  };
  enum State : std::uint8_t { kShared, kOwn, kBusy };  // busy: a thread makes it its own

  /// Stands for a page that is not there, so that none has to be asked before it is read. Never
  /// written to.
  static Page nobodys_page;
  static Page* nobodys() { return &nobodys_page; }

  static void release(Page* page) {
    if (page != nobodys() && page->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete page;
  }

  void own_page(std::uint32_t index) {
    const std::atomic_ref state(states_[index]);
    for (std::uint8_t expected = kShared; !state.compare_exchange_strong(expected, kBusy);
         expected = kShared)
      if (expected == kOwn) return;
    try {
      Page* const before = pages_[index];
      if (before == nobodys() || before->owners.load(std::memory_order_acquire) > 1) {
        auto* const own = new Page;
        own->values = before->values;
        pages_[index] = own;
        release(before);
      }
    } catch (...) {
      state.store(kShared);
      throw;
    }
    state.store(kOwn, std::memory_order_release);
  }

  std::vector<Page*> pages_;
  mutable std::vector<std::uint8_t> states_;  // by page: a copy makes those of both shared
  std::uint32_t count_ = 0;
};

template <typename Value>
constinit typename SharedPages<Value>::Page SharedPages<Value>::nobodys_page;

}  // namespace detail

/// Which blocks of the lattice are allocated, and where. Voxel values live in arrays beside it
/// (VoxelField, VoxelMask), one per quantity, all indexed by VoxelId, so that a stage touches only
/// the bytes it needs and memory follows what is known, not the bounding box.
///
/// A block's number, its slot, never changes: blocks that come later take the next numbers. What
/// must not depend on how a layout came to be (ties, orders of results, files) goes by the order of
/// the blocks, (z, y, x), and in a block of its voxels: `order_of`. A layout that is made at once
/// has its slots in that order.
///
/// Blocks lie within kFarthestBlock along each axis and are kMostBlocks (4.29e9 voxels) or fewer;
/// otherwise InputError is thrown. Safe to read from many threads, not while blocks are added.
class BlockLayout {
 public:
  BlockLayout() = default;
  BlockLayout(const BlockLayout&) = default;  ///< The same blocks in the same slots.
  BlockLayout(BlockLayout&& other) noexcept { swap(other); }  ///< Leaves an empty layout.
  BlockLayout& operator=(const BlockLayout&) = default;       ///< Likewise.
  /// Leaves an empty layout.
  BlockLayout& operator=(BlockLayout&& other) noexcept {
    BlockLayout(std::move(other)).swap(*this);
    return *this;
  }
  ~BlockLayout() = default;

  /// Takes the blocks in any order; doubles count once.
  explicit BlockLayout(std::vector<BlockIndex> blocks);

  /// Adds blocks behind those that are there, in the order in which they come; those that are there
  /// already do not count. All slots stay. Fields follow by their `grow`. Takes time linear in all
  /// blocks: many are better added at once than one by one.
  void add(std::span<const BlockIndex> blocks);

  /// Whether slots are in the blocks' order.
  bool is_in_order() const { return rank_.empty(); }
  /// A block's place in the order of all blocks, and the slot at a place.
  std::uint32_t rank(std::uint32_t slot) const { return rank_.empty() ? slot : rank_[slot]; }
  /// The inverse of `rank`.
  std::uint32_t slot_at(std::uint32_t rank) const { return rank_.empty() ? rank : by_rank_[rank]; }
  /// A voxel's place in the order of all voxels, by block and then by place in it, and the voxel at
  /// a place.
  std::uint32_t order_of(VoxelId id) const {
    return rank_.empty() ? id : rank_[id / kBlockVoxels] * kBlockVoxels + id % kBlockVoxels;
  }
  /// The inverse of `order_of`.
  VoxelId voxel_at_order(std::uint32_t order) const {
    return slot_at(order / kBlockVoxels) * kBlockVoxels + order % kBlockVoxels;
  }

  /// Allocated blocks.
  std::uint32_t block_count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  /// Voxels in them.
  std::size_t voxel_count() const { return blocks_.size() * kBlockVoxels; }
  std::span<const BlockIndex> blocks() const { return blocks_; }  ///< by slot
  /// The block in a slot.
  const BlockIndex& block(std::uint32_t slot) const { return blocks_[slot]; }

  /// Slot of a block, or kNoBlock.
  std::uint32_t find_block(const BlockIndex& block) const {
    if (is_spread_) return find_hashed(block);
    return is_in_box(block) ? table_[place_of(block)] : kNoBlock;
  }
  /// Slot of the block in one of 27 directions from a block, or kNoBlock.
  std::uint32_t neighbour_block(std::uint32_t slot, int direction) const {
    return neighbours_[slot][static_cast<std::size_t>(direction)];
  }

  /// Handle of a voxel, or kNoVoxel where its block is not allocated.
  VoxelId find(const VoxelIndex& voxel) const {
    const std::uint32_t slot = find_block(block_of(voxel));
    return slot == kNoBlock ? kNoVoxel
                            : slot * kBlockVoxels + static_cast<VoxelId>(local_of(voxel));
  }
  /// The voxel of a handle, which must be one of this layout.
  VoxelIndex index_of(VoxelId id) const {
    return voxel_of(blocks_[id / kBlockVoxels], static_cast<int>(id % kBlockVoxels));
  }

  /// Handle of the 26-neighbour in a direction, or kNoVoxel.
  VoxelId neighbour(VoxelId id, int direction) const {
    if (has_neighbour_in_block(id, direction)) return neighbour_in_block(id, direction);
    const VoxelIndex o = offset_of(direction);
    return step(id, o.x, o.y, o.z);
  }

  /// Handle of the voxel at a small offset (each part within -8..8), or kNoVoxel.
  VoxelId step(VoxelId id, int dx, int dy, int dz) const {
    const int x = static_cast<int>(id & 7) + dx;
    const int y = static_cast<int>(id >> 3 & 7) + dy;
    const int z = static_cast<int>(id >> 6 & 7) + dz;
    std::uint32_t slot = id / kBlockVoxels;
    if (((x | y | z) & ~7) != 0) {
      const int direction = (x >> 3) + 1 + 3 * ((y >> 3) + 1) + 9 * ((z >> 3) + 1);
      slot = neighbours_[slot][static_cast<std::size_t>(direction)];
      if (slot == kNoBlock) return kNoVoxel;
    }
    return slot * kBlockVoxels + static_cast<VoxelId>((x & 7) | (y & 7) << 3 | (z & 7) << 6);
  }

  std::size_t memory_bytes() const;  ///< Bytes that the layout takes, those of fields not counted.

  /// Stands for a block that is not allocated.
  static constexpr std::uint32_t kNoBlock = 0xffffffffu;
  /// So many have handles of 32 bits, kNoVoxel left out.
  static constexpr std::uint32_t kMostBlocks = (1u << 23) - 1;
  /// One more than maps reach: where unknown space is ignored, blocks are put around the map's.
  static constexpr int kFarthestBlock = kMaxVoxelIndex / kBlockSide + 1;

  /// The same blocks in the same slots.
  friend bool operator==(const BlockLayout& a, const BlockLayout& b) {
    return a.blocks_ == b.blocks_;
  }

  /// What a field remembers of the layout that it belongs to: layouts with the same blocks in the
  /// same slots have the same stamp, others hardly ever.
  std::uint64_t stamp() const { return stamp_; }
  /// The stamp of the layout as it was when it had so many blocks.
  std::uint64_t stamp_of_first(std::uint32_t count) const;

 private:
  void swap(BlockLayout& other) noexcept;
  /// From one number up to another; downwards more than any extent.
  static std::uint32_t steps(int from, int to) {
    return static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from);
  }
  void require_legal(std::uint32_t first) const;
  void append(std::span<const BlockIndex> blocks);
  void drop_doubles(std::uint32_t first);
  void index_blocks();
  void index_blocks_from(std::uint32_t first);
  bool is_in_box(const BlockIndex& block) const {
    return steps(low_.x, block.x) < extent_[0] && steps(low_.y, block.y) < extent_[1] &&
           steps(low_.z, block.z) < extent_[2];
  }
  std::size_t place_of(const BlockIndex& block) const {  // in the table of that box
    return steps(low_.x, block.x) +
           std::size_t{extent_[0]} *
               (steps(low_.y, block.y) + std::size_t{extent_[1]} * steps(low_.z, block.z));
  }
  void hash_blocks();
  std::uint32_t find_hashed(const BlockIndex& block) const;
  void find_neighbours(std::uint32_t slot);
  void order_blocks(std::uint32_t first_new);

  std::vector<BlockIndex> blocks_;
  detail::SharedPages<std::array<std::uint32_t, 27>> neighbours_;
  // Empty where slots are in order: places in the order by slot, and slots by place.
  std::vector<std::uint32_t> rank_, by_rank_;
  // Slots, kNoBlock where there is none: by place in the box around all blocks, or where they are
  // few in it by hash.
  std::vector<std::uint32_t> table_;
  std::uint64_t stamp_ = 0;
  BlockIndex low_;
  std::array<std::uint32_t, 3> extent_{};
  bool is_spread_ = false;
};

/// Finds voxels that are mostly near one another, as along a line: remembers the block it was in.
/// For one thread.
class VoxelFinder {
 public:
  /// The layout must outlive it, and stay as it is.
  explicit VoxelFinder(const BlockLayout& layout) : layout_(layout) {}

  /// Handle of a voxel, or kNoVoxel where its block is not allocated.
  VoxelId find(const VoxelIndex& voxel) {
    const std::uint32_t slot = find_block(block_of(voxel));
    return slot == BlockLayout::kNoBlock
               ? kNoVoxel
               : slot * kBlockVoxels + static_cast<VoxelId>(local_of(voxel));
  }

  /// Slot of a block, or BlockLayout::kNoBlock.
  std::uint32_t find_block(const BlockIndex& block) {
    if (!has_block_ || block != block_) {
      slot_ = layout_.find_block(block);
      block_ = block;
      has_block_ = true;
    }
    return slot_;
  }

 private:
  const BlockLayout& layout_;
  BlockIndex block_{};
  std::uint32_t slot_ = BlockLayout::kNoBlock;
  bool has_block_ = false;
};

}  // namespace ridgeway
