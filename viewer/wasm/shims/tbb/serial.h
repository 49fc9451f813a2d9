// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

/// The part of oneTBB that the library uses, on one thread: for the planner that runs in the page,
/// as Debian has no oneTBB for WebAssembly. Results do not depend on the number of threads.
namespace tbb {

template <typename Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, std::size_t /*grain*/ = 1) : begin_(begin), end_(end) {}
  Value begin() const { return begin_; }
  Value end() const { return end_; }
  bool empty() const { return !(begin_ < end_); }

 private:
  Value begin_, end_;
};

template <typename Range, typename Body>
void parallel_for(const Range& range, const Body& body) {
  if (!range.empty()) body(range);
}

template <typename... Works>
void parallel_invoke(const Works&... works) {
  (works(), ...);
}

template <typename Iterator, typename... Less>
void parallel_sort(Iterator begin, Iterator end, const Less&... less) {
  std::sort(begin, end, less...);
}

template <typename Value>
class enumerable_thread_specific {
 public:
  Value& local() { return value_; }

 private:
  Value value_;
};

/// Nobody cancels anything.
inline bool is_current_task_group_canceling() { return false; }

class task_arena {
 public:
  static constexpr int automatic = -1;
  explicit task_arena(int /*threads*/ = automatic) {}
  template <typename Work>
  auto execute(Work&& work) {
    return std::forward<Work>(work)();
  }
};

namespace info {
inline int default_concurrency() { return 1; }
}  // namespace info

}  // namespace tbb
