// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>

namespace ridgeway::detail {

/// Asks the system to keep an array, not written yet, in pages of 2 MiB where it has them: what is
/// read here and there waits less for addresses to be looked up. Only advice.
void ask_for_large_pages(void* memory, std::size_t bytes);

}  // namespace ridgeway::detail
