// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>

#include "common/clock.hpp"

namespace ridgeway::detail {

/// When a query has to give up.
struct Deadline {
  double at;  ///< seconds_now() of the end
  explicit Deadline(double time_limit) : at(seconds_now() + time_limit) {}
  static Deadline never() { return Deadline(std::numeric_limits<double>::infinity()); }
  bool has_passed() const { return seconds_now() > at; }
};

}  // namespace ridgeway::detail
