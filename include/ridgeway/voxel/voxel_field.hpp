// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/block_layout.hpp"

namespace ridgeway {
namespace detail {

/// Asks the system to keep an array, not written yet, in pages of 2 MiB where it has them: what is
/// read here and there waits less for addresses to be looked up. Only advice.
void ask_for_large_pages(void* memory, std::size_t bytes);

/// Leaves plain values as the system gives their memory, so that the thread that first writes a
/// page is the one that waits for it.
template <typename Value>
struct UnsetAllocator : std::allocator<Value> {
  void construct(Value* at) {
    if constexpr (!std::is_trivially_copyable_v<Value>) ::new (static_cast<void*>(at)) Value();
  }
  template <typename... Arguments>
  void construct(Value* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) Value(std::forward<Arguments>(arguments)...);
  }
};

}  // namespace detail

/// In what pages memory is asked for: large ones are for what queries read here and there.
enum class Pages { kUsual, kLarge };

/// One value for every voxel of a layout's blocks, by handle.
template <typename Value>
class VoxelField {
 public:
  using Values = std::vector<Value, detail::UnsetAllocator<Value>>;

  VoxelField() = default;
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
    field.values_.resize(layout.voxel_count());
    if (pages == Pages::kLarge)
      detail::ask_for_large_pages(field.values_.data(), field.memory_bytes());
    return field;
  }

  /// Follows a layout to which blocks were added since; their voxels get a value, the others keep
  /// theirs.
  void grow(const BlockLayout& layout, Value initial = {}) {
    assert(stamp_ == layout.stamp_of_first(static_cast<std::uint32_t>(size() / kBlockVoxels)));
    values_.resize(layout.voxel_count(), initial);
    stamp_ = layout.stamp();
  }
  /// Whether this is a field of a layout, for assertions where both are handed in.
  bool is_of(const BlockLayout& layout) const {
    return stamp_ == layout.stamp() && size() == layout.voxel_count();
  }

  Value& operator[](VoxelId id) { return values_[id]; }
  const Value& operator[](VoxelId id) const { return values_[id]; }
  std::size_t size() const { return values_.size(); }
  /// The 512 values of a block, x fastest.
  Value* block(std::uint32_t slot) { return values_.data() + std::size_t{slot} * kBlockVoxels; }
  const Value* block(std::uint32_t slot) const {
    return values_.data() + std::size_t{slot} * kBlockVoxels;
  }
  Values& values() { return values_; }
  const Values& values() const { return values_; }
  std::size_t memory_bytes() const { return values_.capacity() * sizeof(Value); }

 private:
  Values values_;
  std::uint64_t stamp_ = 0;  // of the layout
};

}  // namespace ridgeway
