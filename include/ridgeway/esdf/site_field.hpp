// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "ridgeway/voxel/voxel_field.hpp"

namespace ridgeway {

/// Offset from a voxel to its nearest site, voxels.
struct SiteOffset {
  std::int16_t x = 0;  ///< along x
  std::int16_t y = 0;  ///< along y
  std::int16_t z = 0;  ///< along z
  /// Equal in every field.
  friend constexpr bool operator==(const SiteOffset&, const SiteOffset&) = default;
};

/// The longest part of an offset that is kept in a byte an axis, voxels.
inline constexpr int kFarthestNear = 127;

/// The same in half the memory, where no part of it is longer than kFarthestNear.
struct NearSiteOffset {
  std::int8_t x = 0;  ///< along x
  std::int8_t y = 0;  ///< along y
  std::int8_t z = 0;  ///< along z

  /// Whether an offset can be one.
  static constexpr bool can_be(const SiteOffset& o) {
    const auto fits = [](int k) { return -kFarthestNear <= k && k <= kFarthestNear; };
    return fits(o.x) && fits(o.y) && fits(o.z);
  }
  /// Of one that can.
  static constexpr NearSiteOffset of(const SiteOffset& o) {
    return {static_cast<std::int8_t>(o.x), static_cast<std::int8_t>(o.y),
            static_cast<std::int8_t>(o.z)};
  }
  /// As any offset.
  // NOLINTNEXTLINE(google-explicit-constructor): the same value
  constexpr operator SiteOffset() const { return {x, y, z}; }
  /// Equal in every field.
  friend constexpr bool operator==(const NearSiteOffset&, const NearSiteOffset&) = default;
};

/// For each voxel of a layout an offset, in one of two forms: near ones, which take half the
/// memory, or any. What it holds is the same in either. As VoxelField in all else.
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

/// From each voxel to its nearest site.
using SiteField = OffsetField<NearSiteOffset, SiteOffset>;

}  // namespace ridgeway
