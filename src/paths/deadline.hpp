// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <chrono>
#include <limits>

namespace ridgeway::detail {

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// When a query has to give up.
struct Deadline {
  double at;  ///< seconds_now() of the end
  explicit Deadline(double time_limit) : at(seconds_now() + time_limit) {}
  static Deadline never() { return Deadline(std::numeric_limits<double>::infinity()); }
  bool has_passed() const { return seconds_now() > at; }
};

}  // namespace ridgeway::detail
