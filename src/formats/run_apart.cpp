// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "run_apart.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <system_error>

#include "files/little_endian.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

using Bytes = std::vector<std::byte>;
using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr std::size_t kLength = sizeof(std::uint64_t);  // sent first, to tell what came over whole

[[noreturn]] void fail() {
  throw InputError("reader", "cannot be started: " + std::generic_category().message(errno),
                   "close other programs");
}

void write_all(int pipe, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return;
    if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

/// The life of the child. It leaves by _exit: what the parent has open and buffered is not its own.
[[noreturn]] void serve(const std::function<Bytes()>& work, unsigned seconds, int pipe) {
  const rlimit no_core{0, 0}, time{seconds, seconds};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setrlimit(RLIMIT_CPU, &time);
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0)
    for (const int printed : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, printed);
  try {
    const Bytes bytes = work();
    const std::uint64_t length = bytes.size();
    write_all(pipe, std::as_bytes(std::span(&length, 1)));
    write_all(pipe, bytes);
  } catch (...) {  // told by what is missing
  }
  ::_exit(0);
}

Bytes read_all(std::FILE* stream) {
  Bytes bytes;
  std::array<std::byte, 1 << 16> piece;
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), stream))
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count));
  return bytes;
}

}  // namespace

std::optional<Bytes> run_apart(const std::function<Bytes()>& work, unsigned seconds) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail();
  const Stream in(::fdopen(ends[0], "rb"), std::fclose);
  const pid_t child = in ? ::fork() : -1;
  if (child == 0) serve(work, seconds, ends[1]);
  ::close(ends[1]);
  if (child < 0) fail();
  Bytes bytes = read_all(in.get());
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (bytes.size() < kLength || number_at<std::uint64_t>(bytes, 0) != bytes.size() - kLength)
    return std::nullopt;
  bytes.erase(bytes.begin(), bytes.begin() + kLength);
  return bytes;
}

}  // namespace ridgeway
