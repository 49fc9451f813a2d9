// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "ridgeway/common/error.hpp"
#include "ridgeway/files/atomic_file.hpp"
#include "ridgeway/mapping/map_transform.hpp"
#include "ridgeway/mapping/voxel_range.hpp"

namespace ridgeway::cli {
namespace {

constexpr std::string_view kSeparators = ", \t";

std::string quoted(std::string_view text) {
  std::string result(1, '\'');
  return result.append(text).append(1, '\'');
}

/// Rotation whose columns are where the source's axes point to in the target.
Eigen::Isometry3d turn(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                       const Eigen::Vector3d& z) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() << x, y, z;
  return transform;
}

Eigen::Isometry3d from_position_and_angles(const std::vector<double>& v) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  transform.linear() = (Eigen::AngleAxisd(radians(v[5]), Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(radians(v[4]), Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(radians(v[3]), Eigen::Vector3d::UnitX()))
                           .toRotationMatrix();
  return transform;
}

bool is_negative_list(std::string_view text) {
  return text.size() >= 2 && text[0] == '-' && text.find(',') != std::string_view::npos &&
         ((text[1] >= '0' && text[1] <= '9') || text[1] == '.' || text.substr(1, 3) == "inf" ||
          text.substr(1, 3) == "nan");
}

}  // namespace

std::vector<double> parse_numbers(std::string_view text, const std::string& option) {
  std::vector<double> values;
  for (std::string_view rest = text;;) {
    const std::size_t begin = rest.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) return values;
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(kSeparators));
    const char* first = word.data() + (word.front() == '+' ? 1 : 0);
    const char* last = word.data() + word.size();
    double value = 0.0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || std::isnan(value))
      throw InputError(option + " " + quoted(text), quoted(word) + " is no number",
                       "give numbers between commas, such as 1.5,-2,0.7");
    values.push_back(value);
    rest.remove_prefix(word.size());
  }
}

Point parse_point(std::string_view text, const std::string& option) {
  const std::vector<double> v = parse_numbers(text, option);
  if (v.size() != 3 || !std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
    throw InputError(option + " " + quoted(text), "is no point",
                     "give three finite coordinates in metres: X,Y,Z");
  return {v[0], v[1], v[2]};
}

Box parse_box(std::string_view text, const std::string& option) {
  const std::vector<double> v = parse_numbers(text, option);
  const std::string name = option + " " + quoted(text);
  if (v.size() != 6) throw InputError(name, "is no box", "give six numbers: x0,y0,z0,x1,y1,z1");
  Box box = {Point(v[0], v[1], v[2]), Point(v[3], v[4], v[5])};
  validate_box(box, name);
  return box;
}

Eigen::Isometry3d parse_transform(std::string_view text, const std::string& option) {
  using Eigen::Vector3d;
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  if (text == "camera") return turn(-y, -z, x);
  if (text == "y-up") return turn(x, z, -y);

  const std::string name = option + " " + quoted(text);
  const std::vector<double> v = parse_numbers(text, option);
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  if (v.size() == 6) {
    transform = from_position_and_angles(v);
  } else if (v.size() == 16) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
    if (transform.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      throw InputError(name, "does not end with the row 0,0,0,1",
                       "give the matrix row by row, lengths in metres");
  } else {
    throw InputError(name, "has " + std::to_string(v.size()) + " numbers",
                     "give x,y,z,roll,pitch,yaw, 16 numbers of a matrix, 'camera' or 'y-up'");
  }
  validate_transform(transform);
  return transform;
}

void require_writable(const std::vector<std::filesystem::path>& files,
                      const std::vector<std::filesystem::path>& inputs) {
  const auto is_same = [](const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    return std::filesystem::weakly_canonical(a, error) ==
               std::filesystem::weakly_canonical(b, error) ||
           std::filesystem::equivalent(a, b, error);
  };
  for (auto file = files.begin(); file != files.end(); ++file) {
    for (const std::filesystem::path& input : inputs)
      if (is_same(*file, input))
        throw InputError(file->string(), "is a file that is read", "give another one to write to");
    for (auto other = files.begin(); other != file; ++other)
      if (is_same(*file, *other))
        throw InputError(file->string(), "would be written twice", "give two names");
    const AtomicFile probe(*file);  // without commit it leaves nothing behind
  }
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& help) {
  constexpr double kLargest = 1.8e19;  // below 2^64
  command.add_option("--seed", seed, help)->check(CLI::Range(0.0, kLargest))->capture_default_str();
}

std::vector<std::string> join_negative_values(int argc, const char* const* argv) {
  std::vector<std::string> joined;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool continues = !joined.empty() && joined.back().starts_with("--") &&
                           joined.back().size() > 2 && joined.back().find('=') == std::string::npos;
    if (continues && is_negative_list(word))
      joined.back().append("=").append(word);
    else
      joined.push_back(word);
  }
  return joined;
}

}  // namespace ridgeway::cli
