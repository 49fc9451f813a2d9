// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace ridgeway {

/// The shortest decimal text that reads back as the same number, whatever the locale.
template <typename Number>
std::string number_text(Number value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

}  // namespace ridgeway
