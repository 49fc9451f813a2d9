// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include "common/clock.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::detail {

/// Asks a caller whether to go on from a loop whose rounds may take microseconds: the first time,
/// then twenty times a second at most.
class Asking {
 public:
  explicit Asking(const Progress& progress) : progress_(progress) {}

  /// False once the caller said so, who is not asked again.
  bool may_go_on(std::string_view stage, double share) {
    if (!progress_ || cancelled_ || seconds_now() < next_) return !cancelled_;
    cancelled_ = !progress_(stage, share);
    next_ = seconds_now() + kBetween;
    return !cancelled_;
  }

  bool is_cancelled() const { return cancelled_; }

  /// The same as may_go_on(); throws Cancelled.
  void go_on(std::string_view stage, double share) {
    if (!may_go_on(stage, share)) throw Cancelled();
  }

 private:
  static constexpr double kBetween = 0.05;  // seconds

  const Progress& progress_;
  double next_ = 0.0;
  bool cancelled_ = false;
};

}  // namespace ridgeway::detail
