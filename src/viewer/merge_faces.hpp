// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace ridgeway::detail {

/// Faces of one plane: a bit each, rows of them.
template <std::size_t kRows>
using FacePlane = std::array<std::uint32_t, kRows>;

/// Takes rectangles out of a plane until no face is left: calls take(bit, row, width, height).
template <std::size_t kRows, typename Take>
void merge_faces(FacePlane<kRows>& plane, const Take& take) {
  for (std::size_t row = 0; row < kRows; ++row) {
    std::uint32_t& bits = plane[row];
    while (bits != 0) {
      const int bit = std::countr_zero(bits), width = std::countr_one(bits >> bit);
      const std::uint32_t run = (width == 32 ? ~0u : (1u << width) - 1) << bit;
      std::size_t end = row;
      while (end < kRows && (plane[end] & run) == run) plane[end++] &= ~run;
      take(bit, static_cast<int>(row), width, static_cast<int>(end - row));
    }
  }
}

}  // namespace ridgeway::detail
