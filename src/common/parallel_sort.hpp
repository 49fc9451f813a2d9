// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <tbb/parallel_sort.h>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {

/// Sorts, in parallel. Throws Cancelled as parallel_for_each_index does: what is cancelled is not
/// sorted.
template <typename Iterator, typename... Less>
void parallel_sort(Iterator begin, Iterator end, const Less&... less) {
  tbb::parallel_sort(begin, end, less...);
  stop_if_cancelled();
}

}  // namespace ridgeway::detail
