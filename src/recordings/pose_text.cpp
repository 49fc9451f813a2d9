// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "pose_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "common/number_text.hpp"
#include "files/read_file.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr double kRounding = 1e-2;      // of rotations in text
constexpr std::size_t kMostWords = 64;  // in a line

bool separates(char c) { return is_blank(c) || c == ','; }

/// Cuts the next word off the front of a line; empty at its end and before a comment.
std::string_view take_entry(std::string_view& line) {
  const auto first = std::find_if_not(line.begin(), line.end(), separates);
  if (first == line.end() || *first == '#') return {};
  const auto last = std::find_if(first, line.end(), separates);
  const std::string_view entry(first, last);
  line = {last, line.end()};
  return entry;
}

/// The beginning of a word, as a terminal can take it.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  return text;
}

}  // namespace

bool is_there(const std::filesystem::path& path) {
  std::error_code hidden;
  return std::filesystem::exists(path, hidden);
}

void TextRow::refuse(const std::string& what, const std::string& remedy) const {
  throw InputError(file.string() + " line " + std::to_string(line), what, remedy);
}

double TextRow::number(std::size_t place, const std::string& remedy) const {
  if (place >= words.size()) refuse("is too short", remedy);
  std::string_view rest = words[place];
  double value = 0.0;
  if (!take_number(rest, value) || !rest.empty())
    refuse("has '" + shown(words[place]) + "', which is no number", remedy);
  return value;
}

void for_each_row(const std::filesystem::path& file,
                  const std::function<void(const TextRow&)>& body, Lines lines) {
  const std::string bytes = read_file(file);
  std::string_view rest = bytes;
  if (lines == Lines::kWhole) rest = rest.substr(0, rest.rfind('\n') + 1);  // npos + 1 is 0
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);              // byte order mark
  for (TextRow row{file, 1, {}}; !rest.empty(); ++row.line) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    row.words.clear();
    if (line.find('\0') != line.npos) row.refuse("holds a zero byte", "give a file of text");
    for (std::string_view word = take_entry(line); !word.empty(); word = take_entry(line)) {
      if (row.words.size() == kMostWords) row.refuse("is too long", "give a line for each entry");
      row.words.push_back(word);
    }
    if (!row.words.empty()) body(row);
  }
}

std::vector<double> read_numbers(const std::filesystem::path& file, std::size_t count,
                                 const std::string& remedy) {
  std::vector<double> numbers;
  for_each_row(file, [&](const TextRow& row) {
    for (std::size_t i = 0; i < row.words.size(); ++i) numbers.push_back(row.number(i, remedy));
    if (numbers.size() > count) row.refuse("is one too many", remedy);
  });
  if (numbers.size() < count)
    throw InputError(file.string(), "has " + std::to_string(numbers.size()) + " numbers", remedy);
  return numbers;
}

std::optional<Eigen::Isometry3d> pose_in_row(const TextRow& row, std::size_t first,
                                             const std::string& remedy) {
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = row.number(first + i, remedy);
  if (!std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); }))
    return std::nullopt;
  const Eigen::Quaterniond turn(v[6], v[3], v[4], v[5]);
  if (!(std::abs(turn.norm() - 1.0) <= kRounding))
    row.refuse("has a quaternion of length " + number_text(turn.norm()), remedy);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

std::optional<Eigen::Isometry3d> pose_of_matrix(const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  if (!matrix.allFinite() || matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0) ||
      !((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm() < kRounding) ||
      turn.determinant() < 0.0)
    return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

}  // namespace ridgeway
