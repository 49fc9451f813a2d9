// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace ridgeway {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Cuts the next word off the front of a line; empty at its end.
inline std::string_view take_word(std::string_view& line) {
  std::size_t first = 0;
  while (first < line.size() && is_blank(line[first])) ++first;
  std::size_t last = first;
  while (last < line.size() && !is_blank(line[last])) ++last;
  const std::string_view word = line.substr(first, last - first);
  line.remove_prefix(last);
  return word;
}

/// Reads a number off the front of a text and cuts it off; false where there is none. Knows a
/// leading "+", nan and inf; whatever the locale.
inline bool take_number(std::string_view& text, double& value) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return false;
  // Out of range: C's function tells too large (infinite) from too small (zero).
  if (error == std::errc::result_out_of_range)
    value = std::strtod(std::string(begin, stop).c_str(), nullptr);
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return true;
}

/// A word that is a number from end to end.
template <typename Number>
std::optional<Number> to_number(std::string_view word) {
  Number value{};
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || stop != word.data() + word.size() || word.empty())
    return std::nullopt;
  return value;
}

}  // namespace ridgeway
