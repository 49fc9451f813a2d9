// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

/// What libc++ 14, which emscripten comes with, lacks of C++20, as far as the library uses it.
namespace std {

inline to_chars_result to_chars(char* first, char* last, double value) {
  char text[40];
  int length = 0;
  for (int digits = 15; digits <= 17; ++digits) {
    length = snprintf(text, sizeof text, "%.*g", digits, value);
    if (strtod(text, nullptr) == value) break;
  }
  if (last - first < length) return {last, errc::value_too_large};
  for (int i = 0; i < length; ++i) first[i] = text[i];
  return {first + length, errc()};
}

/// Of the texts that the page sends: decimal numbers.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string text(first, last);
  if (text.empty() || text[0] == ' ' || text[0] == '+' || text.find_first_of("xX") != string::npos)
    return {first, errc::invalid_argument};
  char* end = nullptr;
  value = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  return {first + (end - text.c_str()), errc()};
}

template <typename To, typename From>
To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  __builtin_memcpy(&to, &from, sizeof to);
  return to;
}

/// On one thread.
template <typename Value>
class atomic_ref {
 public:
  explicit atomic_ref(Value& value) : value_(value) {}
  Value load(memory_order = memory_order_seq_cst) const { return value_; }
  void store(Value value, memory_order = memory_order_seq_cst) const { value_ = value; }
  Value fetch_or(Value bits, memory_order = memory_order_seq_cst) const {
    const Value before = value_;
    value_ |= bits;
    return before;
  }
  Value fetch_and(Value bits, memory_order = memory_order_seq_cst) const {
    const Value before = value_;
    value_ &= bits;
    return before;
  }
  bool compare_exchange_strong(Value& expected, Value desired,
                               memory_order = memory_order_seq_cst) const {
    if (value_ != expected) {
      expected = value_;
      return false;
    }
    value_ = desired;
    return true;
  }

 private:
  Value& value_;
};

}  // namespace std
