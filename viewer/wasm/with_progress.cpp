// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

/// Pages have one thread: work is asked for its progress by itself alone.
void run_with_progress(const Progress& progress, std::string_view /*stage*/,
                       const std::function<void(const Progress& report)>& work) {
  work(progress);
}

}  // namespace ridgeway::detail
