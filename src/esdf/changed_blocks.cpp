// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "changed_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeway::detail {

ChangedBlocks::ChangedBlocks(const BlockLayout& layout, std::span<const std::uint32_t> slots) {
  if (slots.empty()) return;
  BlockIndex high = low_ = layout.block(slots.front());
  for (const std::uint32_t slot : slots) {
    const BlockIndex& b = layout.block(slot);
    low_ = {std::min(low_.x, b.x), std::min(low_.y, b.y), std::min(low_.z, b.z)};
    high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
  }
  const double places = (high.x - low_.x + 1.0) * (high.y - low_.y + 1.0) * (high.z - low_.z + 1.0);
  constexpr double kMostPlaces = 1e7;
  are_all_ = places > kMostPlaces;
  if (are_all_) return;
  extent_ = high - low_ + BlockIndex{1, 1, 1};
  sums_.assign(static_cast<std::size_t>(places), 0);
  for (const std::uint32_t slot : slots) {
    const BlockIndex b = layout.block(slot) - low_;
    sum(b.x, b.y, b.z) = 1;
  }
  for (int z = 0; z < extent_.z; ++z)
    for (int y = 0; y < extent_.y; ++y)
      for (int x = 1; x < extent_.x; ++x) sum(x, y, z) += sum(x - 1, y, z);
  for (int z = 0; z < extent_.z; ++z)
    for (int y = 1; y < extent_.y; ++y)
      for (int x = 0; x < extent_.x; ++x) sum(x, y, z) += sum(x, y - 1, z);
  for (int z = 1; z < extent_.z; ++z)
    for (int y = 0; y < extent_.y; ++y)
      for (int x = 0; x < extent_.x; ++x) sum(x, y, z) += sum(x, y, z - 1);
}

std::uint32_t& ChangedBlocks::sum(int x, int y, int z) {
  return sums_[static_cast<std::size_t>(x) +
               static_cast<std::size_t>(extent_.x) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(extent_.y) * static_cast<std::size_t>(z))];
}

/// Up to a place in the box, itself included; -1 is before the first.
std::uint32_t ChangedBlocks::sum_up_to(int x, int y, int z) const {
  if (x < 0 || y < 0 || z < 0) return 0;
  return sums_[static_cast<std::size_t>(x) +
               static_cast<std::size_t>(extent_.x) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(extent_.y) * static_cast<std::size_t>(z))];
}

bool ChangedBlocks::touch(const Point& low, const Point& high) const {
  if (sums_.empty()) return are_all_;
  const auto clamped = [](double voxel, int from, int extent) {
    return static_cast<int>(
               std::clamp(std::floor(voxel / kBlockSide), from - 1.0, from + 0.0 + extent)) -
           from;
  };
  const int x0 = std::max(clamped(low.x(), low_.x, extent_.x), 0);
  const int y0 = std::max(clamped(low.y(), low_.y, extent_.y), 0);
  const int z0 = std::max(clamped(low.z(), low_.z, extent_.z), 0);
  const int x1 = std::min(clamped(high.x(), low_.x, extent_.x), extent_.x - 1);
  const int y1 = std::min(clamped(high.y(), low_.y, extent_.y), extent_.y - 1);
  const int z1 = std::min(clamped(high.z(), low_.z, extent_.z), extent_.z - 1);
  if (x0 > x1 || y0 > y1 || z0 > z1) return false;
  const auto layer = [&](int z) {
    return sum_up_to(x1, y1, z) - sum_up_to(x0 - 1, y1, z) - sum_up_to(x1, y0 - 1, z) +
           sum_up_to(x0 - 1, y0 - 1, z);
  };
  return layer(z1) != layer(z0 - 1);
}

}  // namespace ridgeway::detail
