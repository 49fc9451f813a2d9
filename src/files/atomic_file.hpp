// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "temporary.hpp"

namespace ridgeway {

/// A file that appears whole or not at all: bytes go to a temporary file in the target's folder,
/// `commit` flushes it to the disk and renames it. Without `commit` (an exception, an early
/// return) the temporary file is removed and whatever stood at the target stays as it was.
/// Every failure (no such folder, no permission, disk full) is an InputError with the path.
class AtomicFile {
 public:
  /// Opens the temporary file. A target that exists and is no regular file is refused; a link is
  /// followed, so that the file it points to is replaced.
  explicit AtomicFile(const std::filesystem::path& target);

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) {
    write(std::as_bytes(std::span<const char>(text.data(), text.size())));
  }
  void commit();

 private:
  static std::filesystem::path checked(const std::filesystem::path& target);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path target_;
  Temporary temporary_;
};

/// Writes a whole text by AtomicFile.
void write_text_file(const std::filesystem::path& target, std::string_view text);

}  // namespace ridgeway
