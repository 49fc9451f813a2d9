// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace ridgeway::detail {

/// Bytes that this process has from the allocator and has not given back; 0 where it does not tell.
std::uint64_t allocated_bytes();

/// Gives memory that has been freed back to the system, so that the next one to ask for some pays
/// for its pages, as in a new process.
void release_freed_memory();

/// Runs `work` in a process of its own and returns the peak of that process's resident memory,
/// bytes; nothing where it threw or the system gives no process. What `work` changes in memory is
/// lost. Memory that this process holds counts, and threads that it has do not come along: for the
/// beginning of a program.
std::optional<std::uint64_t> peak_memory_of(const std::function<void()>& work);

}  // namespace ridgeway::detail
