// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ridgeway {

struct ProgramLimits {
  double seconds = 60.0;              ///< from its start, by the clock on the wall
  std::size_t most_bytes = 1u << 30;  ///< of output
};

struct ProgramOutput {
  enum class End {
    kClosed,    ///< it closed its output, be it that it ended well, failed or crashed
    kTimedOut,  ///< and was killed, like those that follow
    kTooLong,
    kCancelled
  };
  End end = End::kClosed;
  std::vector<std::byte> bytes;  ///< of its standard output
};

/// Runs a program and collects what it writes to its standard output; it gets no input, and its
/// errors go nowhere. Spawned, not forked: safe whatever threads this process has. It is of a
/// process group of its own, so that Ctrl-C on a terminal reaches this process alone, which
/// decides. `go_on`, if any, is called some twenty times a second; false kills the program. When
/// this returns, or throws, the program has ended, with what it started in its group, and left no
/// zombie. Throws InputError where it cannot be started.
ProgramOutput run_program(const std::filesystem::path& program,
                          const std::vector<std::string>& arguments, const ProgramLimits& limits,
                          const std::function<bool()>& go_on = {});

}  // namespace ridgeway
