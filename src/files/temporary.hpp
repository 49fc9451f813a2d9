// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <filesystem>

namespace ridgeway {

/// A file or a folder that takes shape beside its target, under a hidden name of its own, and is
/// gone with this object unless it was moved there. It is locked while it is in use: what killed
/// processes have left in the folder of the target has no lock, and is removed first.
class Temporary {
 public:
  enum class Kind : std::uint8_t { kFile, kFolder };

  /// Makes it; where that fails `error` says why, as errno does.
  Temporary(const std::filesystem::path& target, Kind kind);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  int error() const { return error_; }
  const std::filesystem::path& path() const { return path_; }
  /// Of the file, open for writing, or of the folder.
  int descriptor() const { return descriptor_; }

  /// Closes it and gives it the target's name, in place of what has that name. Returns 0, or the
  /// error of the step that failed.
  int move_to(const std::filesystem::path& target);

 private:
  bool make(Kind kind);

  std::filesystem::path path_;  // empty once it was moved
  int descriptor_ = -1;
  int error_ = 0;
  int slot_ = -1;  // where its name is kept for remove_temporaries
};

/// Removes all that the process has at the moment. For a handler of signals that ends the process
/// then: nothing but system calls is used. No other thread may write to them meanwhile.
void remove_temporaries() noexcept;

}  // namespace ridgeway
