// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "ridgeway/common/error.hpp"

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
#define RIDGEWAY_UNSANITIZED __attribute__((no_sanitize("thread")))
#else
#define RIDGEWAY_UNSANITIZED
#endif

namespace ridgeway::detail {

/// Tells the thread sanitizer what it cannot see inside the precompiled oneTBB: tasks run after
/// their loop has begun and before it ends, by an exception too. Races between tasks stay visible.
/// Nothing otherwise.
#ifdef RIDGEWAY_THREAD_SANITIZER
class ForkJoin {
 public:
  ForkJoin() { __tsan_release(&begin_); }
  ~ForkJoin() { __tsan_acquire(&end_); }
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  /// One task, as long as it runs.
  class Task {
   public:
    explicit Task(ForkJoin& loop) : loop_(loop) { __tsan_acquire(&loop_.begin_); }
    ~Task() { __tsan_release(&loop_.end_); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    ForkJoin& loop_;
  };

 private:
  char begin_ = 0, end_ = 0;
};
#else
struct ForkJoin {
  struct Task {
    explicit Task(ForkJoin&) {}
  };
};
#endif

/// Calls body(i) for each i of [first, last).
template <typename Body>
void for_each_index(std::size_t first, std::size_t last, const Body& body) {
  for (std::size_t i = first; i != last; ++i) body(i);
}

/// Throws Cancelled where what this is part of was cancelled: its loops end early then, and leave
/// undone what they were to do.
inline void stop_if_cancelled() {
  if (tbb::is_current_task_group_canceling()) throw Cancelled();
}

/// What with_progress does.
void run_with_progress(const Progress& progress, std::string_view stage,
                       const std::function<void(const Progress& report)>& work);

}  // namespace ridgeway::detail

namespace ridgeway {

/// Runs `body(i)` for every i in [0, count), in parallel and in any order. The result must not
/// depend on the order: each call writes only what belongs to its own i. Throws Cancelled where it
/// is part of something that was cancelled (with_progress, a task group of the caller's).
template <typename Body>
void parallel_for_each_index(std::size_t count, const Body& body, std::size_t grain = 1) {
  detail::ForkJoin loop;
  // oneTBB hands it from thread to thread, out of the sanitizer's sight.
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) RIDGEWAY_UNSANITIZED {
    const detail::ForkJoin::Task task(loop);
    detail::for_each_index(range.begin(), range.end(), body);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), run);
  detail::stop_if_cancelled();
}

/// Runs `work()` with at most `threads` threads (0, or more than it has: all of the machine's) and
/// returns its result.
template <typename Work>
auto with_threads(int threads, Work&& work) {
  const int most = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, most) : tbb::task_arena::automatic);
  return arena.execute(std::forward<Work>(work));
}

/// Makes work that takes long one that can be cancelled anywhere: runs `work(report)` on a thread
/// of its own, with as many threads as the caller may have, and asks `progress`, in the calling
/// thread, twenty times a second and whenever the work does by `report` (a Progress, too). `stage`
/// is what it is asked for before the work has named one. Once it says no, the library's loops end
/// early and Cancelled is thrown, in the work and from here; what the work was changing is of no
/// use then. Returns the work's result, throws what the work or `progress` throws. Without
/// `progress` it is a plain call.
template <typename Work>
auto with_progress(const Progress& progress, std::string_view stage, Work&& work) {
  using Result = std::invoke_result_t<Work&, const Progress&>;
  if constexpr (std::is_void_v<Result>) {
    detail::run_with_progress(progress, stage, [&](const Progress& report) { work(report); });
  } else {
    std::optional<Result> result;
    detail::run_with_progress(progress, stage,
                              [&](const Progress& report) { result.emplace(work(report)); });
    return Result(std::move(*result));
  }
}

}  // namespace ridgeway
