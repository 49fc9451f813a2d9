// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#if defined(__SANITIZE_THREAD__)  // gcc
#define RIDGEWAY_THREAD_SANITIZER
#elif defined(__has_feature)  // clang
#if __has_feature(thread_sanitizer)
#define RIDGEWAY_THREAD_SANITIZER
#endif
#endif

#ifdef RIDGEWAY_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace ridgeway::detail {

/// Tells the thread sanitizer what it cannot see inside the precompiled oneTBB: tasks run after
/// their loop has begun and before it ends. Races between tasks stay visible. Nothing otherwise.
class ForkJoin {
 public:
#ifdef RIDGEWAY_THREAD_SANITIZER
  ForkJoin() { __tsan_release(&begin_); }
  void enter() { __tsan_acquire(&begin_); }
  void leave() { __tsan_release(&end_); }
  void join() { __tsan_acquire(&end_); }

 private:
  char begin_ = 0, end_ = 0;
#else
  void enter() {}
  void leave() {}
  void join() {}
#endif
};

}  // namespace ridgeway::detail

namespace ridgeway {

/// Runs `body(i)` for every i in [0, count), in parallel and in any order. The result must not
/// depend on the order: each call writes only what belongs to its own i.
template <typename Body>
void parallel_for_each_index(std::size_t count, const Body& body, std::size_t grain = 1) {
  detail::ForkJoin order;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      order.enter();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                      order.leave();
                    });
  order.join();
}

/// Runs `work()` with at most `threads` threads (0, or more than it has: all of the machine's) and
/// returns its result.
template <typename Work>
auto with_threads(int threads, Work&& work) {
  const int most = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, most) : tbb::task_arena::automatic);
  return arena.execute(std::forward<Work>(work));
}

}  // namespace ridgeway
