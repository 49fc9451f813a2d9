// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

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
