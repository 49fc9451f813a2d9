// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <chrono>
#include <ctime>
#include <utility>

namespace ridgeway::detail {

/// Seconds since some moment; never goes back. For differences.
inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of processor time of this thread; for differences. What else runs on the machine hardly
/// counts.
inline double thread_seconds_now() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Times one step after the other.
class Lap {
 public:
  /// Of the step that ends now.
  double seconds() {
    const double before = std::exchange(start_, seconds_now());
    return start_ - before;
  }

 private:
  double start_ = seconds_now();
};

}  // namespace ridgeway::detail
