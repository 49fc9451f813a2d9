// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "run_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <span>
#include <system_error>

#include "ridgeway/common/error.hpp"

extern char** environ;

namespace ridgeway {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProgramOutput::End;

constexpr std::chrono::milliseconds kPatience{50};  // between two looks at go_on

[[noreturn]] void fail(const std::filesystem::path& program, int error) {
  throw InputError(program.string(), "cannot be started: " + std::generic_category().message(error),
                   "close other programs, or install it again");
}

class Pipe {
 public:
  explicit Pipe(const std::filesystem::path& program) {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) fail(program, errno);
  }
  ~Pipe() {
    ::close(ends_[0]);
    close_writing();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{};
};

/// A process that does not outlive this object.
class Child {
 public:
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments, int out) {
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // What the host does with signals is no matter of the program.
    posix_spawnattr_t attributes;
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    std::string name = program.string();
    std::vector<std::string> owned = arguments;
    std::vector<char*> words = {name.data()};
    for (std::string& word : owned) words.push_back(word.data());
    words.push_back(nullptr);
    const int error =
        ::posix_spawn(&pid_, name.c_str(), &files, &attributes, words.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    if (error != 0) fail(program, error);
  }

  /// Killed if it still runs, and reaped. Where the host has reaped it already, its number may be
  /// another's by now: then nothing is killed.
  ~Child() {
    const pid_t ended = wait(WNOHANG);
    if (ended != 0) return;
    ::kill(-pid_, SIGKILL);  // with what it started: it is the first of its group
    wait(0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t wait(int options) const {
    pid_t ended = 0;
    do ended = ::waitpid(pid_, nullptr, options);
    while (ended < 0 && errno == EINTR);
    return ended;
  }

  pid_t pid_ = 0;
};

/// Waits for bytes, or the end of them, a little while.
bool is_readable(int pipe, Clock::duration longest) {
  const auto wait = std::chrono::ceil<std::chrono::milliseconds>(
      std::clamp<Clock::duration>(longest, Clock::duration::zero(), kPatience));
  pollfd file{pipe, POLLIN, 0};
  return ::poll(&file, 1, static_cast<int>(wait.count())) > 0;
}

/// Reads what there is. Nothing: it would have been interrupted. False: the end.
std::optional<bool> read_some(int pipe, std::vector<std::byte>& bytes) {
  std::array<std::byte, 1 << 16> piece;
  const ssize_t count = ::read(pipe, piece.data(), piece.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN ? std::nullopt : std::optional(false);
  const auto read = std::span(piece).first(static_cast<std::size_t>(count));
  bytes.insert(bytes.end(), read.begin(), read.end());
  return count > 0;
}

}  // namespace

ProgramOutput run_program(const std::filesystem::path& program,
                          const std::vector<std::string>& arguments, const ProgramLimits& limits,
                          const std::function<bool()>& go_on) {
  const auto longest = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::clamp(limits.seconds, 0.0, 1e6)));
  const Clock::time_point deadline = Clock::now() + longest;
  Pipe pipe(program);
  const Child child(program, arguments, pipe.writing());
  pipe.close_writing();
  for (ProgramOutput output;;) {
    if (go_on && !go_on()) return {End::kCancelled, {}};
    const Clock::duration left = deadline - Clock::now();
    if (left <= Clock::duration::zero()) return {End::kTimedOut, {}};
    if (!is_readable(pipe.reading(), left)) continue;
    if (read_some(pipe.reading(), output.bytes) == false) return output;
    if (output.bytes.size() > limits.most_bytes) return {End::kTooLong, {}};
  }
}

}  // namespace ridgeway
