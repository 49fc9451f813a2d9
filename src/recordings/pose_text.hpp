// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeway {

/// Whether there is such a file or folder; false too where nobody may look.
bool is_there(const std::filesystem::path& path);

/// A line of a text file, split at blanks and commas, without its comment ("# ..."). Its complaints
/// name the file and the line.
struct TextRow {
  const std::filesystem::path& file;
  std::size_t line;
  std::vector<std::string_view> words;

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const;
  /// The word at a place as a number; "nan" and "inf" are numbers too.
  double number(std::size_t place, const std::string& remedy) const;
};

/// Which lines count: all, or those that end, as the last one of a file that grows may be half of
/// what it will be, and half a number is a number.
enum class Lines : std::uint8_t { kAll, kWhole };

/// Calls body(row) for the lines that are not empty. Throws InputError for a file that cannot be
/// read and for lines of more than a few dozen words.
void for_each_row(const std::filesystem::path& file,
                  const std::function<void(const TextRow&)>& body, Lines lines = Lines::kAll);

/// The numbers of a file of so many. Throws InputError where there are more or fewer.
std::vector<double> read_numbers(const std::filesystem::path& file, std::size_t count,
                                 const std::string& remedy);

/// The pose "tx ty tz qx qy qz qw" that begins at a word; nothing where a number is not finite
/// ("lost"). Throws InputError where the quaternion is not of length one.
std::optional<Eigen::Isometry3d> pose_in_row(const TextRow& row, std::size_t first,
                                             const std::string& remedy);

/// The pose of a matrix that text has rounded, its rotation made exact; nothing where it is none.
std::optional<Eigen::Isometry3d> pose_of_matrix(const Eigen::Matrix4d& matrix);

}  // namespace ridgeway
