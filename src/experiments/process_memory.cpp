// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "process_memory.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace ridgeway::detail {
namespace {

/// The life of the child. It leaves by _exit: what the parent has buffered is not its own.
[[noreturn]] void serve(const std::function<void()>& work) {
  try {
    work();
  } catch (...) {  // told by the status
    ::_exit(1);
  }
  ::_exit(0);
}

}  // namespace

std::uint64_t allocated_bytes() {
#ifdef __GLIBC__
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

void release_freed_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

std::optional<std::uint64_t> peak_memory_of(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) serve(work);
  if (child < 0) return std::nullopt;
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) return std::nullopt;
  if (status != 0) return std::nullopt;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace ridgeway::detail
