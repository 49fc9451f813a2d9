// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {
namespace detail {

/// Asks the system to keep an array, not written yet, in pages of 2 MiB where it has them: what is
/// read here and there waits less for addresses to be looked up. Only advice.
void ask_for_large_pages(void* memory, std::size_t bytes);

/// Memory as the system gives it, so that the thread that first writes a page is the one that waits
/// for it.
inline std::shared_ptr<void> unset_memory(std::size_t bytes) {
  return {::operator new(bytes), [](void* memory) { ::operator delete(memory); }};
}

}  // namespace detail

/// In what pages memory is asked for: large ones are for what queries read here and there.
enum class Pages { kUsual, kLarge };

/// One value for every voxel of a layout's blocks, by handle.
///
/// A copy is a field of its own. Two fields may also share the memory of blocks that are the same
/// in both: see shared() and own_block().
template <typename Value>
class VoxelField {
  static_assert(std::is_trivially_destructible_v<Value>);

 public:
  VoxelField() = default;
  /// One value for all voxels of a layout.
  explicit VoxelField(const BlockLayout& layout, Value initial = {}, Pages pages = Pages::kUsual)
      : VoxelField(unset(layout, pages)) {
    parallel_for_each_index(
        layout.block_count(),
        [&](std::size_t slot) {
          std::fill_n(block(static_cast<std::uint32_t>(slot)), kBlockVoxels, initial);
        },
        64);
  }
  /// Values as they come: every one must be written before it is read.
  static VoxelField unset(const BlockLayout& layout, Pages pages = Pages::kUsual) {
    VoxelField field;
    field.stamp_ = layout.stamp();
    field.take_memory(layout.block_count(), pages);
    return field;
  }

  /// The same values in memory of its own.
  VoxelField(const VoxelField& other) : stamp_(other.stamp_) {
    take_memory(other.blocks_.size(), Pages::kUsual);
    for (std::size_t slot = 0; slot < blocks_.size(); ++slot)
      std::copy_n(other.blocks_[slot], kBlockVoxels, blocks_[slot]);
  }
  VoxelField(VoxelField&&) noexcept = default;  ///< Leaves an empty field.
  /// The same values in memory of its own.
  VoxelField& operator=(const VoxelField& other) { return *this = VoxelField(other); }
  VoxelField& operator=(VoxelField&&) noexcept = default;  ///< Leaves an empty field.
  ~VoxelField() = default;

  /// A field with the same values in the same memory, for 8 bytes a block. Neither of the two may
  /// be written to from then on but for blocks that were made its own.
  VoxelField shared() const {
    VoxelField field;
    field.stamp_ = stamp_;
    field.whole_ = whole_;
    field.owners_ = owners_;
    field.blocks_ = blocks_;
    return field;
  }
  /// Gives a field that shares its memory a copy of a block of its own; other threads may do so
  /// with other blocks. `grow` has to have been called before.
  void own_block(std::uint32_t slot) {
    auto own = std::make_shared<OwnBlock>();
    Value* const values = own->values.data();
    std::uninitialized_copy_n(blocks_[slot], kBlockVoxels, values);
    owners_.own(slot) = std::move(own);
    blocks_[slot] = values;
  }

  /// Gives a field the memory that another one of its layout has for a block, for both as after
  /// shared(); other threads may do so with other blocks. `grow` or `follow` has to have been
  /// called before.
  void share_block(const VoxelField& other, std::uint32_t slot) {
    const bool is_own =
        slot < other.owners_.size() && std::as_const(other.owners_)[slot] != nullptr;
    owners_.own(slot) = is_own ? std::as_const(other.owners_)[slot] : other.whole_;
    blocks_[slot] = other.blocks_[slot];
  }

  /// Follows another field, whose layout has more blocks by now, at the end: those in its memory.
  void follow(const VoxelField& other) {
    owners_.grow(static_cast<std::uint32_t>(other.blocks_.size()));
    const std::size_t before = blocks_.size();
    blocks_.resize(other.blocks_.size());
    for (std::size_t slot = before; slot < blocks_.size(); ++slot)
      share_block(other, static_cast<std::uint32_t>(slot));
    stamp_ = other.stamp_;
  }

  /// Follows a layout to which blocks were added since; their voxels get a value, the others keep
  /// theirs. From then on each block has memory of its own.
  void grow(const BlockLayout& layout, Value initial = {}) {
    assert(stamp_ == layout.stamp_of_first(static_cast<std::uint32_t>(blocks_.size())));
    const std::size_t before = blocks_.size(), count = layout.block_count();
    owners_.grow(layout.block_count());
    if (blocks_.capacity() < count) blocks_.reserve(std::max(count, 2 * blocks_.capacity()));
    for (std::size_t slot = before; slot < count; ++slot) {
      auto own = std::make_shared<OwnBlock>();
      Value* const values = own->values.data();
      std::uninitialized_fill_n(values, kBlockVoxels, initial);
      owners_.own(static_cast<std::uint32_t>(slot)) = std::move(own);
      blocks_.push_back(values);
    }
    stamp_ = layout.stamp();
  }
  /// Whether this is a field of a layout, for assertions where both are handed in.
  bool is_of(const BlockLayout& layout) const {
    return stamp_ == layout.stamp() && blocks_.size() == layout.block_count();
  }

  /// Of a voxel, by its handle in the layout.
  Value& operator[](VoxelId id) { return blocks_[id / kBlockVoxels][id % kBlockVoxels]; }
  /// Of a voxel, by its handle in the layout.
  const Value& operator[](VoxelId id) const {
    return blocks_[id / kBlockVoxels][id % kBlockVoxels];
  }
  /// Voxels that have a value.
  std::size_t size() const { return blocks_.size() * kBlockVoxels; }
  /// The 512 values of a block, x fastest.
  Value* block(std::uint32_t slot) { return blocks_[slot]; }
  /// The 512 values of a block, x fastest.
  const Value* block(std::uint32_t slot) const { return blocks_[slot]; }
  /// All of them, by handle: a copy.
  std::vector<Value> values() const {
    std::vector<Value> all;
    all.reserve(size());
    for (const Value* block : blocks_) all.insert(all.end(), block, block + kBlockVoxels);
    return all;
  }
  /// The same values as ones of another type, in memory of their own.
  template <typename Other>
  VoxelField<Other> as() const {
    VoxelField<Other> field;
    field.stamp_ = stamp_;
    field.take_memory(blocks_.size(), Pages::kUsual);
    field.owners_.grow(owners_.size());
    for (std::size_t slot = 0; slot < blocks_.size(); ++slot)
      std::copy_n(blocks_[slot], kBlockVoxels, field.blocks_[slot]);
    return field;
  }
  /// Counts what is shared too.
  std::size_t memory_bytes() const {
    return size() * sizeof(Value) + blocks_.capacity() * sizeof(Value*);
  }

 private:
  template <typename Other>
  friend class VoxelField;

  /// Memory of one block, in one piece with the count of its owners: as it comes, to be written.
  struct OwnBlock {
    OwnBlock() noexcept {}  // NOLINT(modernize-use-equals-default): which would set the values
    union {
      std::array<Value, kBlockVoxels> values;
    };
  };

  /// All blocks in one piece. Pages are given to it when they are first written: by the threads
  /// that do, so that none waits for all of them.
  void take_memory(std::size_t blocks, Pages pages) {
    if (blocks == 0) return;
    whole_ = detail::unset_memory(blocks * kBlockVoxels * sizeof(Value));
    auto* const first = static_cast<Value*>(whole_.get());
    if constexpr (!std::is_trivially_copyable_v<Value>)
      std::uninitialized_value_construct_n(first, blocks * kBlockVoxels);
    blocks_.reserve(blocks);
    for (std::size_t slot = 0; slot < blocks; ++slot)
      blocks_.push_back(first + slot * kBlockVoxels);
    if (pages == Pages::kLarge) detail::ask_for_large_pages(first, size() * sizeof(Value));
  }

  std::shared_ptr<void> whole_;  // memory of the blocks that have none of their own
  detail::SharedPages<std::shared_ptr<void>> owners_;  // of those that have
  std::vector<Value*> blocks_;                         // by slot
  std::uint64_t stamp_ = 0;                            // of the layout
};

/// For each voxel of a layout an offset, in one of two forms: near ones, which take half the
/// memory, or any. What it holds is the same in either. Else it does what a VoxelField does.
template <typename NearOffset, typename AnyOffset>
class OffsetField {
 public:
  using Near = VoxelField<NearOffset>;  ///< the one form
  using Any = VoxelField<AnyOffset>;    ///< the other

  OffsetField() = default;  ///< Without voxels, for any offsets.
  /// Of values that stand.
  explicit OffsetField(Near near) : field_(std::move(near)) {}
  /// Of values that stand.
  explicit OffsetField(Any any) : field_(std::move(any)) {}

  /// Of a voxel, by its handle in the layout.
  AnyOffset operator[](VoxelId id) const {
    if (const Near* near = std::get_if<Near>(&field_)) return (*near)[id];
    return (*std::get_if<Any>(&field_))[id];
  }
  /// Sets that of a voxel. The first that is not near turns a field of near ones into one of any:
  /// for one thread alone where that may be.
  void set(VoxelId id, const AnyOffset& offset) {
    if (Near* near = std::get_if<Near>(&field_)) {
      if (NearOffset::can_be(offset)) {
        (*near)[id] = NearOffset::of(offset);
        return;
      }
      field_ = near->template as<AnyOffset>();
    }
    (*std::get_if<Any>(&field_))[id] = offset;
  }

  /// Calls body(field) with the VoxelField itself, for loops over many voxels.
  template <typename Body>
  decltype(auto) visit(const Body& body) const {
    return std::visit(body, field_);
  }

  bool has_near_only() const { return std::holds_alternative<Near>(field_); }  ///< its form
  /// Voxels that have a value.
  std::size_t size() const {
    return visit([](const auto& field) { return field.size(); });
  }
  /// See VoxelField.
  bool is_of(const BlockLayout& layout) const {
    return visit([&](const auto& field) { return field.is_of(layout); });
  }
  /// See VoxelField.
  OffsetField shared() const {
    return visit([](const auto& field) { return OffsetField(field.shared()); });
  }
  /// See VoxelField.
  void own_block(std::uint32_t slot) {
    std::visit([&](auto& field) { field.own_block(slot); }, field_);
  }
  /// See VoxelField; `initial` can be a near one.
  void grow(const BlockLayout& layout, const AnyOffset& initial = {}) {
    if (Near* near = std::get_if<Near>(&field_))
      near->grow(layout, NearOffset::of(initial));
    else
      std::get_if<Any>(&field_)->grow(layout, initial);
  }
  /// All of them, by handle: a copy.
  std::vector<AnyOffset> values() const {
    return visit([](const auto& field) {
      const auto values = field.values();
      return std::vector<AnyOffset>(values.begin(), values.end());
    });
  }
  /// Counts what is shared too.
  std::size_t memory_bytes() const {
    return visit([](const auto& field) { return field.memory_bytes(); });
  }

 private:
  std::variant<Any, Near> field_;
};

}  // namespace ridgeway
