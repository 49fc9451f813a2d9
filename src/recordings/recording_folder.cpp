// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "recording_folder.hpp"

#include <sstream>
#include <system_error>

#include "common/number_text.hpp"
#include "files/file_error.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr const char* kNotWritten = "cannot be written";

}  // namespace

std::unique_ptr<Temporary> begin_folder(const std::filesystem::path& folder,
                                        const std::string& inner, std::filesystem::path& target) {
  namespace fs = std::filesystem;
  std::error_code error;
  target = fs::weakly_canonical(fs::absolute(folder, error), error);  // "run/.", and links
  if (!target.has_filename()) target = target.parent_path();          // "run/"
  if (error) detail::fail_file(folder, kNotWritten, error.value());
  if (!target.has_filename())
    throw InputError("'" + folder.string() + "'", "is no folder that can be made",
                     "give a new folder");
  if (fs::exists(target, error) &&
      !(fs::is_directory(target, error) && fs::is_empty(target, error)))
    throw InputError(target.string(), "exists and is not empty", "give a new folder");
  fs::create_directories(target.parent_path(), error);
  if (error) detail::fail_file(target, kNotWritten, error.value());
  auto temporary = std::make_unique<Temporary>(target, Temporary::Kind::kFolder);
  if (temporary->error() != 0) detail::fail_file(target, kNotWritten, temporary->error());
  fs::create_directory(temporary->path() / inner, error);
  if (error) detail::fail_file(target, kNotWritten, error.value());
  return temporary;
}

void finish_folder(Temporary& temporary, const std::filesystem::path& target) {
  if (const int failed = temporary.move_to(target); failed != 0)
    detail::fail_file(target, kNotWritten, failed);
}

std::string numbered(const std::string& before, int number, const std::string& after) {
  std::ostringstream name;
  name << before;
  name.width(6);
  name.fill('0');
  name << number << after;
  return name.str();
}

std::string pose_text(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Point& t = pose.translation();
  std::string text = number_text(t.x());
  for (const double value : {t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    text.append(" ").append(number_text(value));
  return text;
}

}  // namespace ridgeway
