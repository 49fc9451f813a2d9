// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <unordered_set>
#include <vector>

#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway::testing {

/// Components, tunnels and cavities of a set of closed voxel cubes (26-connected foreground).
struct Betti {
  long b0 = 0, b1 = 0, b2 = 0;
  friend bool operator==(const Betti&, const Betti&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Betti& b) {
    return out << "b0 " << b.b0 << " b1 " << b.b1 << " b2 " << b.b2;
  }
};

/// Computed independently of any thinning code: b0 and b2 by flooding the foreground and its
/// complement, b1 from the Euler characteristic, counted cell by cell. Works on a dense copy of
/// the bounding box with a border.
class BettiCounter {
 public:
  BettiCounter(const BlockLayout& layout, const VoxelMask& mask) {
    const std::vector<VoxelId> members = mask.members(layout);
    if (members.empty()) return;
    VoxelIndex low = layout.index_of(members[0]), high = low;
    for (const VoxelId id : members) {
      const VoxelIndex v = layout.index_of(id);
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    size_ = {high.x - low.x + 3, high.y - low.y + 3, high.z - low.z + 3};
    cells_.assign(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                      static_cast<std::size_t>(size_[2]),
                  0);
    for (const VoxelId id : members) {
      const VoxelIndex v = layout.index_of(id) - low;
      cells_[place(v.x + 1, v.y + 1, v.z + 1)] = 1;
    }
  }

  Betti count() {
    if (cells_.empty()) return {};
    Betti b;
    const long euler = euler_characteristic();
    b.b0 = components(1, true);
    b.b2 = components(0, false) - 1;
    b.b1 = b.b0 + b.b2 - euler;
    return b;
  }

 private:
  std::size_t place(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  bool full(int x, int y, int z) const { return cells_[place(x, y, z)] == 1; }

  /// Vertices - edges + faces - cubes of the union of closed cubes. A cell of the complex is there
  /// if any cube around it is.
  long euler_characteristic() const {
    long euler = 0;
    for (int z = 1; z < size_[2]; ++z)
      for (int y = 1; y < size_[1]; ++y)
        for (int x = 1; x < size_[0]; ++x)
          for (int kind = 0; kind < 8; ++kind) {  // bit set: the cell extends along that axis
            bool present = false;
            for (int i = 0; i < 8 && !present; ++i) {
              if ((i & kind) != 0) continue;
              present = full(x - (i & 1), y - (i >> 1 & 1), z - (i >> 2));
            }
            if (present) euler += __builtin_popcount(static_cast<unsigned>(kind)) % 2 ? -1 : 1;
          }
    return euler;
  }

  long components(std::uint8_t value, bool diagonal) {
    std::vector<std::uint8_t> left = cells_;
    std::vector<std::array<int, 3>> stack;
    long parts = 0;
    for (int z = 0; z < size_[2]; ++z)
      for (int y = 0; y < size_[1]; ++y)
        for (int x = 0; x < size_[0]; ++x) {
          if (left[place(x, y, z)] != value) continue;
          ++parts;
          left[place(x, y, z)] = 2;
          stack.push_back({x, y, z});
          while (!stack.empty()) {
            const auto [cx, cy, cz] = stack.back();
            stack.pop_back();
            for (int d = 0; d < 27; ++d) {
              const int dx = d % 3 - 1, dy = d / 3 % 3 - 1, dz = d / 9 - 1;
              if (!diagonal && dx * dx + dy * dy + dz * dz != 1) continue;
              const int nx = cx + dx, ny = cy + dy, nz = cz + dz;
              if (nx < 0 || ny < 0 || nz < 0 || nx >= size_[0] || ny >= size_[1] ||
                  nz >= size_[2] || left[place(nx, ny, nz)] != value)
                continue;
              left[place(nx, ny, nz)] = 2;
              stack.push_back({nx, ny, nz});
            }
          }
        }
    return parts;
  }

  std::array<int, 3> size_{};
  std::vector<std::uint8_t> cells_;  // 1: foreground
};

inline Betti betti_numbers(const BlockLayout& layout, const VoxelMask& mask) {
  return BettiCounter(layout, mask).count();
}

}  // namespace ridgeway::testing
