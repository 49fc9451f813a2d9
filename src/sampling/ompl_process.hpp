// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <limits>
#include <mutex>

#include "common/random.hpp"

// What OMPL keeps once for the whole process, handled so that calls do not disturb one another.
namespace ridgeway::detail {

/// OMPL prints nothing while one of these lives; its messages are as before when the last is gone.
class QuietOmpl {
 public:
  QuietOmpl() {
    const std::lock_guard lock(mutex_);
    if (count_++ == 0) ompl::msg::noOutputHandler();
  }
  ~QuietOmpl() {
    const std::lock_guard lock(mutex_);
    if (--count_ == 0) ompl::msg::restorePreviousOutputHandler();
  }
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;

 private:
  static inline std::mutex mutex_;
  static inline int count_ = 0;
};

/// Seeds for the generators of one call. OMPL draws the seed of each generator from a generator of
/// the process when it is made, deep inside planners and samplers. So whatever makes some is run
/// here, one at a time, after that generator was seeded anew.
class OmplSeeds {
 public:
  explicit OmplSeeds(std::uint64_t seed) : random_(seed) {}

  template <typename Make>
  auto seeded(const Make& make) {
    const std::lock_guard lock(mutex_);
    ompl::RNG::setSeed(1 + random_.below(std::numeric_limits<std::uint32_t>::max() - 1));
    return make();
  }

 private:
  static inline std::recursive_mutex mutex_;  // setting a planner up may allocate samplers
  Random random_;
};

}  // namespace ridgeway::detail
