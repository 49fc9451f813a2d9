// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/voxel/large_pages.hpp"

#include <sys/mman.h>

#include <new>

namespace ridgeway::detail {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::size_t kLeast = 2 * kPage;  // less is as well off in pages of the usual size
constexpr std::align_val_t kAlignment{kPage};

}  // namespace

void* allocate_in_large_pages(std::size_t bytes) {
  if (bytes < kLeast) return ::operator new(bytes);
  void* memory = ::operator new(bytes, kAlignment);
  ::madvise(memory, bytes, MADV_HUGEPAGE);  // advice: all goes on as well where it is not taken
  return memory;
}

void free_large_pages(void* memory, std::size_t bytes) {
  if (bytes < kLeast)
    ::operator delete(memory);
  else
    ::operator delete(memory, kAlignment);
}

}  // namespace ridgeway::detail
