// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace ridgeway {

/// Whether an enumerator, counted from 0, has a name in a table: false for a number that was made
/// one by a cast.
template <typename Enum, std::size_t kCount>
constexpr bool is_in(const std::array<std::string_view, kCount>&, Enum value) {
  return static_cast<std::size_t>(value) < kCount;
}

/// Its name there, or "invalid".
template <typename Enum, std::size_t kCount>
constexpr std::string_view name_in(const std::array<std::string_view, kCount>& names, Enum value) {
  return is_in(names, value) ? names[static_cast<std::size_t>(value)] : "invalid";
}

}  // namespace ridgeway
