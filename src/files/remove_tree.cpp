// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "remove_tree.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ridgeway::detail {
namespace {

constexpr int kDeepest = 16;  // folders in folders; ours have one

/// An entry of a folder as the kernel writes it: readdir takes memory, this does not.
struct Entry {
  std::uint64_t inode;
  std::int64_t next;
  std::uint16_t size;
  std::uint8_t type;
  char name[1];
};

bool is_dots(const char* name) {
  return std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0;
}

void remove_at(int folder, const char* name, int depth) noexcept;

/// Removes what a part of the folder's entries name; false at its end.
bool remove_some(int folder, int depth) noexcept {
  alignas(std::uint64_t) std::array<char, 4096> buffer;
  const long count = ::syscall(SYS_getdents64, folder, buffer.data(), buffer.size());
  if (count <= 0) return false;
  for (std::size_t at = 0; at < static_cast<std::size_t>(count);) {
    std::uint16_t size = 0;
    std::memcpy(&size, buffer.data() + at + offsetof(Entry, size), sizeof(size));
    const char* name = buffer.data() + at + offsetof(Entry, name);
    if (!is_dots(name)) remove_at(folder, name, depth + 1);
    at += size;
  }
  return true;
}

void remove_at(int folder, const char* name, int depth) noexcept {
  if (::unlinkat(folder, name, 0) == 0 || depth > kDeepest) return;
  const int inner = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (inner < 0) return;
  while (remove_some(inner, depth)) {
  }
  ::close(inner);
  ::unlinkat(folder, name, AT_REMOVEDIR);
}

}  // namespace

void remove_tree(const char* path) noexcept { remove_at(AT_FDCWD, path, 0); }

}  // namespace ridgeway::detail
