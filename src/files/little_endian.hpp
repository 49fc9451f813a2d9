// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace ridgeway {

static_assert(std::endian::native == std::endian::little,
              "the binary formats are read and written as they lie in memory");

/// Appends a number as it lies in memory.
template <typename Number>
void append_number(std::vector<std::byte>& bytes, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  const auto raw = std::as_bytes(std::span(&value, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// The `index`-th number of an array that starts at `offset`; the caller has checked the extent.
template <typename Number>
Number number_at(std::span<const std::byte> bytes, std::size_t offset, std::size_t index = 0) {
  static_assert(std::is_arithmetic_v<Number>);
  Number value;
  std::memcpy(&value, bytes.data() + offset + index * sizeof(Number), sizeof(Number));
  return value;
}

}  // namespace ridgeway
