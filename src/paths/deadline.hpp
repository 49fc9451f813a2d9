// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>

#include "common/clock.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

/// When a query has to give up.
struct Deadline {
  double at;  ///< seconds_now() of the end
  explicit Deadline(double time_limit) : at(seconds_now() + time_limit) {}
  static Deadline never() { return Deadline(std::numeric_limits<double>::infinity()); }
  bool is_over() const { return seconds_now() > at; }
  /// The same. Throws Cancelled where the query is part of what was cancelled (with_progress).
  bool has_passed() const {
    stop_if_cancelled();
    return is_over();
  }
  /// The same, asked of the clock once in so many of a search's steps.
  bool has_passed(int step) const {
    constexpr int kStepsBetweenLooks = 1024;
    return step % kStepsBetweenLooks == 0 && has_passed();
  }
};

}  // namespace ridgeway::detail
