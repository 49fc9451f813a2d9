// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "file_error.hpp"

#include <cerrno>
#include <system_error>

#include "ridgeway/common/error.hpp"

namespace ridgeway::detail {
namespace {

const char* remedy_for(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or write to another disk";
    case ENOENT:
    case ENOTDIR:
      return "create the folder first or use another one";
    case EACCES:
    case EPERM:
      return "use a file and a folder that you have the right to, or change their permissions";
    case EROFS:
      return "choose a folder that can be written to";
    case EISDIR:
      return "give the name of a file, not of a folder";
    case ELOOP:
      return "its links lead in a circle: give the file itself";
    case ENAMETOOLONG:
      return "give a shorter name";
    case EMFILE:
    case ENFILE:
      return "too many files are open: close some programs, or raise ulimit -n";
    default:
      return "check the path and the disk";
  }
}

}  // namespace

void fail_file(const std::filesystem::path& file, const std::string& problem, int error) {
  throw InputError(file.string(), problem + ": " + std::generic_category().message(error),
                   remedy_for(error));
}

}  // namespace ridgeway::detail
