// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>

namespace ridgeway::detail {

/// Memory for an array that is read here and there: from a few megabytes on in pages of 2 MiB where
/// the system has them, so that addresses are not looked up anew for every line. Throws
/// std::bad_alloc.
void* allocate_in_large_pages(std::size_t bytes);

/// Gives it back; `bytes` as asked for.
void free_large_pages(void* memory, std::size_t bytes);

}  // namespace ridgeway::detail
