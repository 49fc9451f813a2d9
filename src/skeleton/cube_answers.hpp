// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "simple_point.hpp"

namespace ridgeway::detail {

/// Whether adding a voxel, from the top down, neither starts a basin nor can join two: all its
/// higher neighbours hang together by moves across faces, and one of them is across a face.
constexpr bool is_regular(Cube27 higher) {
  const Cube27 faces = higher & kCells6;
  return faces != 0 && flood6(faces & (~faces + 1), higher) == higher;
}

/// is_regular and is_simple, remembered: among the neighbourhoods of a map few differ. For any
/// number of threads.
class CubeAnswers {
 public:
  struct Answer {
    bool is_regular, is_simple;
  };

  /// `cube`: without its centre.
  Answer of(Cube27 cube) {
    std::atomic<std::uint32_t>& entry = entries_[cube * 0x9e3779b1u >> (32 - kEntryBits)];
    std::uint32_t known = entry.load(std::memory_order_relaxed);
    if (known >> 2 != cube) {
      known = cube << 2 | (is_regular(cube) ? 2u : 0u) | (is_simple(cube) ? 1u : 0u);
      entry.store(known, std::memory_order_relaxed);
    }
    return {(known & 2) != 0, (known & 1) != 0};
  }

 private:
  static constexpr int kEntryBits = 12;  // a table that fits the nearest cache

  // A cube and its answers. Zero is true of the empty cube.
  std::array<std::atomic<std::uint32_t>, 1 << kEntryBits> entries_{};
};

}  // namespace ridgeway::detail
