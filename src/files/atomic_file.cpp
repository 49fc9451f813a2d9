// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "file_error.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace fs = std::filesystem;
namespace {

constexpr const char* kCannotWrite = "cannot be written";

/// The file that a chain of links ends at; the path itself where there is none.
fs::path follow_link(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real;
}

}  // namespace

fs::path AtomicFile::checked(const fs::path& target) {
  fs::path file = follow_link(target);
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (fs::is_directory(status)) detail::fail_file(file, kCannotWrite, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(file.string(), "is no regular file", "give the name of a file");
  return file;
}

AtomicFile::AtomicFile(const fs::path& target)
    : target_(checked(target)), temporary_(target_, Temporary::Kind::kFile) {
  if (temporary_.error() != 0) fail(temporary_.error());
  // Who kept others from reading the file that is replaced wants no less of the new one.
  if (struct stat old{}; ::stat(target_.c_str(), &old) == 0)
    ::fchmod(temporary_.descriptor(), old.st_mode & 0777);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(temporary_.descriptor(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (::fsync(temporary_.descriptor()) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
  if (const int error = temporary_.move_to(target_); error != 0) fail(error);

  // The new name is safe on the disk once the folder is; a file system that cannot do that has
  // the whole file all the same.
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (const int d = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); d >= 0) {
    ::fsync(d);
    ::close(d);
  }
}

void AtomicFile::fail(int error) const { detail::fail_file(target_, kCannotWrite, error); }

void write_text_file(const fs::path& target, std::string_view text) {
  AtomicFile file(target);
  file.write(text);
  file.commit();
}

}  // namespace ridgeway
