// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ridgeway {

/// Whether one name comes before another where runs of digits are compared as the numbers that they
/// are, however long: image_9 before image_10. Names that differ in leading zeros alone are
/// compared as text.
inline bool comes_before(std::string_view a, std::string_view b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto take_run = [&](std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
    std::string_view run = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(run.size());
    run.remove_prefix(std::min(run.find_first_not_of('0'), run.size()));
    return run;
  };
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view left = take_run(a), right = take_run(b);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;
}

/// The last number in a name, where there is one that is not too long: 4 in frame-000004.depth.png.
inline std::optional<std::int64_t> last_number(std::string_view name) {
  constexpr std::size_t kLongest = 18;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto last = std::find_if(name.rbegin(), name.rend(), is_digit);
  const auto first = std::find_if_not(last, name.rend(), is_digit);
  if (last == name.rend() || first - last > static_cast<std::ptrdiff_t>(kLongest)) return {};
  std::int64_t number = 0;
  for (auto digit = first; digit != last;) number = 10 * number + (*--digit - '0');
  return number;
}

}  // namespace ridgeway
