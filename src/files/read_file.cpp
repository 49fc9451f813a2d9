// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "read_file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "file_error.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr const char* kCannotRead = "cannot be read";

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(name, "there is no such file", "check the path");
  if (!std::filesystem::status_known(status)) detail::fail_file(file, kCannotRead, error.value());
  if (std::filesystem::is_directory(status)) throw InputError(name, "is a folder", "give a file");
  if (!std::filesystem::is_regular_file(status))
    throw InputError(name, "is not a regular file", "copy its contents to a file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) detail::fail_file(file, kCannotRead, error.value());
  if (size == 0) throw InputError(name, "is empty", "fetch or write it again");
  if (size > available_memory_bytes())
    throw InputError(name, "is larger than the memory available", "use a machine with more");
  std::string bytes(size, '\0');
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) detail::fail_file(file, kCannotRead, errno);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw InputError(name, "cannot be read to its end", "check the disk, or fetch it again");
  return bytes;
}

}  // namespace ridgeway
