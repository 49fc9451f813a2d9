// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>

#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

constexpr std::chrono::milliseconds kBetween(50);  // two questions

/// What the thread that asks and the one that works tell each other.
class Conversation {
 public:
  Conversation(const Progress& progress, std::string_view stage)
      : progress_(progress), stage_(stage) {}

  /// Of the thread that works: tells how far it is, and waits to hear whether to go on.
  bool report(std::string_view stage, double share) {
    std::unique_lock lock(mutex_);
    stage_ = stage;
    share_ = share;
    is_reported_ = true;
    told_.notify_all();
    told_.wait(lock, [&] { return !is_reported_; });
    return go_on_;
  }

  /// Of the thread that works: it has ended, with what it threw.
  void end(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    is_done_ = true;
    told_.notify_all();
  }

  /// Of the thread that asks: until the work has ended. `loops`: what to cancel.
  void listen(tbb::task_group_context& loops) {
    std::unique_lock lock(mutex_);
    for (;;) {
      told_.wait_for(lock, kBetween, [&] { return is_done_ || is_reported_; });
      if (is_done_) return;
      if (go_on_) ask(lock);
      // Again each time: what was said before the loops began may be lost.
      if (!go_on_) loops.cancel_group_execution();
      if (is_reported_) {
        is_reported_ = false;
        told_.notify_all();
      }
    }
  }

  /// After that: throws what was thrown, or Cancelled.
  void conclude() const {
    if (refusal_) std::rethrow_exception(refusal_);
    if (!go_on_) throw Cancelled();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void ask(std::unique_lock<std::mutex>& lock) {
    const std::string stage = stage_;
    const double share = share_;
    lock.unlock();
    bool answer = false;
    try {
      answer = progress_(stage, share);
    } catch (...) {
      refusal_ = std::current_exception();
    }
    lock.lock();
    go_on_ = answer;
  }

  const Progress& progress_;
  std::mutex mutex_;
  std::condition_variable told_;
  std::string stage_;
  double share_ = 0.0;
  bool is_reported_ = false;  // and not answered yet
  bool is_done_ = false;
  bool go_on_ = true;
  std::exception_ptr failure_;  // of the work
  std::exception_ptr refusal_;  // of progress_
};

}  // namespace

void run_with_progress(const Progress& progress, std::string_view stage,
                       const std::function<void(const Progress& report)>& work) {
  if (!progress) {
    work(progress);
    return;
  }
  Conversation conversation(progress, stage);
  tbb::task_group_context loops;
  // The caller waits in its arena, where it may be the only thread that there is room for.
  tbb::task_arena arena(tbb::this_task_arena::max_concurrency());
  const Progress report = [&](std::string_view at, double share) {
    return conversation.report(at, share);
  };
  const auto run = [&] {
    std::exception_ptr failure;
    try {
      arena.execute([&] {
        // One body, so that all loops in it belong to `loops`.
        tbb::parallel_for(
            tbb::blocked_range<int>(0, 1),
            [&](const tbb::blocked_range<int>&) {
              try {
                work(report);
              } catch (...) {
                failure = std::current_exception();
              }
            },
            loops);
      });
    } catch (...) {
      failure = std::current_exception();
    }
    conversation.end(std::move(failure));
  };
  std::thread worker;
  try {
    worker = std::thread(run);
  } catch (const std::system_error&) {  // no other thread can be had
    work(progress);
    return;
  }
  conversation.listen(loops);
  worker.join();
  conversation.conclude();
}

}  // namespace ridgeway::detail
