// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "threads.hpp"

#include <pthread.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <vector>

#include "console.hpp"

namespace ridgeway::cli {
namespace {

/// How many threads of `wanted` can be had at once beside this one: found by making them, for the
/// limits of users, sessions and containers are many. Takes some 20 microseconds each.
int available_threads(int wanted) {
  std::mutex until_all_are_made;
  std::vector<pthread_t> made;
  {
    const std::lock_guard<std::mutex> lock(until_all_are_made);
    const auto wait = [](void* mutex) -> void* {
      const std::lock_guard<std::mutex> end(*static_cast<std::mutex*>(mutex));
      return nullptr;
    };
    pthread_t thread{};
    while (static_cast<int>(made.size()) < wanted &&
           ::pthread_create(&thread, nullptr, wait, &until_all_are_made) == 0)
      made.push_back(thread);
  }
  for (const pthread_t thread : made) ::pthread_join(thread, nullptr);
  return static_cast<int>(made.size());
}

}  // namespace

int threads_to_use(const Globals& globals) {
  const int most = tbb::info::default_concurrency();
  const int wanted = globals.threads > 0 ? std::min(globals.threads, most) : most;
  const int allowed = 1 + available_threads(most - 1);
  if (allowed == most) return wanted;
  if (allowed < wanted)
    warn(globals, "the system allows " + std::to_string(allowed) + " of " + std::to_string(wanted) +
                      " threads: this takes longer");
  static std::optional<tbb::global_control> bound;
  bound.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(allowed));
  return std::min(wanted, allowed);
}

}  // namespace ridgeway::cli
