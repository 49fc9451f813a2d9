// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <system_error>

#include "common/number_text.hpp"
#include "files/atomic_file.hpp"
#include "files/text.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::cli {
namespace {

constexpr std::string_view kSeparators = ", \t";

/// A number from end to end of a word; nothing where it is none.
std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || std::isnan(value)) return {};
  if (value != 0.0 && !std::isinf(value) && !std::isnormal(value)) return {};
  return value;
}

/// Of a coordinate: beyond all maps.
bool is_too_far(double value) {
  constexpr double kFarthest = 1e9;
  return !(std::abs(value) <= kFarthest);
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

bool is_negative(std::string_view text) {
  return text.size() >= 2 && text[0] == '-' &&
         ((text[1] >= '0' && text[1] <= '9') || text[1] == '.' || text.substr(1, 3) == "inf" ||
          text.substr(1, 3) == "nan");
}

/// The file that a name leads to, whether it is there or not.
std::filesystem::path file_of(const std::filesystem::path& name) {
  std::error_code error;
  std::filesystem::path absolute = std::filesystem::absolute(name, error);
  std::filesystem::path file = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute : file;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string result(1, '\'');
  if (text.size() <= kMost) return result.append(text).append(1, '\'');
  return result.append(text.substr(0, kMost)).append("'...");
}

std::string box_text(const Box& box) {
  std::string text;
  for (const Point& corner : {box.min, box.max})
    for (const double value : corner)
      text.append(text.empty() ? "" : ",").append(number_text(value));
  return text;
}

std::string range_text(const Range& range) {
  std::string text = range.above ? "above " + number_text(range.least) + ", at most "
                                 : "from " + number_text(range.least) + " to ";
  text += number_text(range.most);
  return range.endless ? text + ", or inf" : text;
}

double parse_number(std::string_view text, const Range& range, const std::string& option) {
  const std::optional<double> value = number_of(text);
  const std::string name = option + " " + in_quotes(text), remedy = "give one " + range_text(range);
  if (!value) throw InputError(name, "is no number", remedy);
  const bool is_in =
      *value <= range.most && (range.above ? *value > range.least : *value >= range.least);
  if (!is_in && !(range.endless && std::isinf(*value) && *value > 0.0))
    throw InputError(name, "is out of range", remedy);
  return *value;
}

std::uint64_t parse_whole(std::string_view text, const Wholes& range, const std::string& option) {
  std::uint64_t value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  const std::string name = option + " " + in_quotes(text);
  const std::string remedy =
      "give one from " + number_text(range.least) + " to " + number_text(range.most);
  if (error == std::errc::invalid_argument || end != last)
    throw InputError(name, "is no whole number", remedy);
  if (error != std::errc() || value < range.least || value > range.most)
    throw InputError(name, "is out of range", remedy);
  return value;
}

std::vector<double> parse_numbers(std::string_view text, const std::string& option) {
  std::vector<double> values;
  for (std::string_view rest = text;;) {
    const std::size_t begin = rest.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) return values;
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(kSeparators));
    const std::optional<double> value = number_of(word);
    if (!value)
      throw InputError(option + " " + in_quotes(text), in_quotes(word) + " is no number",
                       "give numbers between commas, such as 1.5,-2,0.7");
    values.push_back(*value);
    rest.remove_prefix(word.size());
  }
}

Point parse_point(std::string_view text, const std::string& option, const std::string& shown) {
  const std::vector<double> v = parse_numbers(text, option);
  if (v.size() != 3 || std::any_of(v.begin(), v.end(), is_too_far))
    throw InputError(option + " " + in_quotes(text), "is no point",
                     "give three numbers of at most 1e9: " + shown);
  return {v[0], v[1], v[2]};
}

Box parse_box(std::string_view text, const std::string& option) {
  const std::vector<double> v = parse_numbers(text, option);
  const std::string name = option + " " + in_quotes(text);
  if (v.size() != 6) throw InputError(name, "is no box", "give six numbers: x0,y0,z0,x1,y1,z1");
  if (std::any_of(v.begin(), v.end(), [](double x) { return std::isfinite(x) && is_too_far(x); }))
    throw InputError(name, "is too large", "give metres of at most 1e9, or inf for no limit");
  Box box = {Point(v[0], v[1], v[2]), Point(v[3], v[4], v[5])};
  validate_box(box, name);
  return box;
}

Eigen::Isometry3d parse_transform(std::string_view text, const std::string& option) {
  using Eigen::Vector3d;
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  if (text == "camera") return turn(-y, -z, x);
  if (text == "y-up") return turn(x, z, -y);

  const std::string name = option + " " + in_quotes(text);
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
    return file_of(a) == file_of(b) || std::filesystem::equivalent(a, b, error);
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

void require_outside(const std::filesystem::path& folder,
                     const std::vector<std::filesystem::path>& files) {
  std::filesystem::path whole = file_of(folder);
  if (!whole.has_filename()) whole = whole.parent_path();  // "run/"
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path named = file_of(file);
    const auto [in_folder, in_file] =
        std::mismatch(whole.begin(), whole.end(), named.begin(), named.end());
    if (in_folder == whole.end())
      throw InputError(file.string(), "lies in a folder that is written, " + folder.string(),
                       "give another place for one of them");
  }
}

void require_extension(const std::filesystem::path& file, const std::string& what,
                       std::initializer_list<const char*> extensions) {
  std::string names;
  for (const char* extension : extensions) {
    if (extension_of(file) == extension) return;
    names.append(names.empty() ? "" : " or ").append(extension);
  }
  throw InputError(file.string(), "is no name for " + what, "let it end in " + names);
}

std::vector<std::string> join_values(int argc, const char* const* argv) {
  std::vector<std::string> joined;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool is_long = word.size() > 2 && word.starts_with("--");
    if (is_long && word.find('=') == word.size() - 1)
      throw InputError(word.substr(0, word.size() - 1) + " ''", "is empty", "give a value");
    const bool continues = !joined.empty() && joined.back().starts_with("--") &&
                           joined.back().size() > 2 && joined.back().find('=') == std::string::npos;
    if (continues && is_negative(word))
      joined.back().append("=").append(word);
    else
      joined.push_back(word);
  }
  return joined;
}

}  // namespace ridgeway::cli
