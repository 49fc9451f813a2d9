// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace ridgeway {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// The same text with a to z for A to Z, whatever the locale.
inline std::string in_small_letters(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// What a file's name ends in, from its last dot on, in small letters: `MAP.PLY` is a .ply.
inline std::string extension_of(const std::filesystem::path& file) {
  return in_small_letters(file.extension().string());
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

/// What a number means that no double can hold: infinite, or zero. C's function would tell, but
/// takes from the locale what stands for the point.
inline double beyond_all(std::string_view number) {
  std::istringstream stream{std::string(number)};
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;  // the largest double where it is too large
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return std::abs(value) >= 1.0 ? std::copysign(kInfinity, value) : value;
}

/// Reads a number off the front of a text and cuts it off; false where there is none. Knows a
/// leading "+", nan and inf; whatever the locale.
inline bool take_number(std::string_view& text, double& value) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range)
    value = beyond_all(std::string_view(begin, static_cast<std::size_t>(stop - begin)));
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
