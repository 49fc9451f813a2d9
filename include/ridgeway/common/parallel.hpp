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

#include "ridgeway/common/fork_join.hpp"

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
