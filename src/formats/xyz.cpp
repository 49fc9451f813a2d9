// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "xyz.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include "files/byte_reader.hpp"
#include "files/text.hpp"

namespace ridgeway {
namespace {

/// What may stand beside x, y and z: colour, intensity, normals, time, and what scanners and
/// classifiers number. No second corner, size or radius: those would be solids, not points.
constexpr std::array<std::string_view, 40> kKnown = {"r",
                                                     "g",
                                                     "b",
                                                     "a",
                                                     "red",
                                                     "green",
                                                     "blue",
                                                     "alpha",
                                                     "rgb",
                                                     "rgba",
                                                     "i",
                                                     "intensity",
                                                     "intensities",
                                                     "reflectance",
                                                     "reflectivity",
                                                     "nx",
                                                     "ny",
                                                     "nz",
                                                     "normalx",
                                                     "normaly",
                                                     "normalz",
                                                     "curvature",
                                                     "t",
                                                     "time",
                                                     "timestamp",
                                                     "gpstime",
                                                     "label",
                                                     "class",
                                                     "classification",
                                                     "ring",
                                                     "line",
                                                     "tag",
                                                     "id",
                                                     "index",
                                                     "confidence",
                                                     "returnnumber",
                                                     "numberofreturns",
                                                     "pointsourceid",
                                                     "userdata",
                                                     "scanangle"};

bool is_mark(char c) { return c == ',' || c == ';'; }

/// Cuts entries off the front of a line. Blanks part them, and so does a comma or semicolon with
/// blanks around it; between two of these, and after one that ends the line, there is an empty one.
class Entries {
 public:
  explicit Entries(std::string_view line) : line_(line) { skip_blanks(); }

  /// Nothing at the line's end.
  std::optional<std::string_view> next() {
    if (line_.empty() && !std::exchange(is_after_mark_, false)) return std::nullopt;
    const auto end =
        std::find_if(line_.begin(), line_.end(), [](char c) { return is_blank(c) || is_mark(c); });
    const std::string_view entry = line_.substr(0, static_cast<std::size_t>(end - line_.begin()));
    line_.remove_prefix(entry.size());
    skip_blanks();
    is_after_mark_ = !line_.empty() && is_mark(line_[0]);
    if (!is_after_mark_) return entry;
    line_.remove_prefix(1);
    skip_blanks();
    return entry;
  }

  bool is_at_end() const { return line_.empty() && !is_after_mark_; }

 private:
  void skip_blanks() {
    while (!line_.empty() && is_blank(line_[0])) line_.remove_prefix(1);
  }

  std::string_view line_;
  bool is_after_mark_ = false;
};

/// Small letters and digits alone: Gps_Time and "gpstime" are the same.
std::string plain(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

/// What the columns of a text are.
struct XyzColumns {
  std::size_t count = 3;
  std::array<std::size_t, 3> xyz = {0, 1, 2};
  bool are_named = false;
};

/// Names of columns, or the first one that is none.
struct Names {
  std::optional<XyzColumns> columns;
  std::string_view unknown;
};

Names read_names(std::string_view line) {
  XyzColumns columns{.count = 0, .are_named = true};
  std::array<int, 3> found{};
  Entries entries(line);
  for (auto entry = entries.next(); entry; entry = entries.next(), ++columns.count) {
    const std::string name = plain(*entry);
    if (name.empty() && entries.is_at_end()) break;
    if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
      const auto axis = static_cast<std::size_t>(name[0] - 'x');
      columns.xyz[axis] = columns.count;
      ++found[axis];
    } else if (!name.empty() && std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end()) {
      return {std::nullopt, *entry};
    }
  }
  if (found != std::array{1, 1, 1}) return {};
  return {columns, {}};
}

/// Points of a text, line by line.
class XyzReader {
 public:
  explicit XyzReader(const std::string& name) : name_(name) {}

  PointCloud read(std::string_view bytes) {
    cloud_.points.reserve(bytes.size() / 24);
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // byte order mark
    for (ByteReader reader(bytes, name_); reader.remaining() > 0;) {
      std::string_view line = reader.take_line();
      ++line_number_;
      while (!line.empty() && is_blank(line[0])) line.remove_prefix(1);
      if (line.empty()) continue;
      if (line[0] == '#' || line.starts_with("//"))
        read_comment(line.substr(line[0] == '#' ? 1 : 2));
      else if (!read_point(line))
        read_first_line(line);
    }
    return std::move(cloud_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw InputError(name_, "line " + std::to_string(line_number_) + " " + what, remedy);
  }

  bool has_begun() const { return !cloud_.points.empty() || cloud_.skipped > 0; }

  /// A comment before the points may be the names of the columns.
  void read_comment(std::string_view text) {
    if (const auto names = read_names(text); names.columns && !has_begun())
      columns_ = *names.columns;
  }

  void read_first_line(std::string_view line) {
    const Names names = has_begun() || columns_.are_named ? Names{} : read_names(line);
    if (!names.unknown.empty() && plain(line).starts_with('x'))
      refuse("names a column '" + std::string(names.unknown.substr(0, 40)) +
                 "', which may make its rows other things than points",
             "keep the columns of points: x, y, z, colour, intensity, normals, time or labels");
    if (!names.columns)
      refuse("does not begin with x, y, z",
             "give three numbers a line, separated by blanks or commas");
    columns_ = *names.columns;
  }

  /// False where a coordinate is no number.
  bool read_point(std::string_view line) {
    std::size_t count = 0;
    bool is_point = true;
    Entries entries(line);
    for (auto entry = entries.next(); entry; entry = entries.next(), ++count) {
      if (entry->empty() && entries.is_at_end() && count == columns_.count) break;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (columns_.xyz[axis] == count)
          is_point = is_point && take_number(*entry, point_[axis]) && entry->empty();
    }
    if (!is_point || count < 3) return false;
    if (count != columns_.count) refuse_columns(count);
    cloud_.add(point_[0], point_[1], point_[2]);
    return true;
  }

  [[noreturn]] void refuse_columns(std::size_t count) const {
    const std::string found = "has " + std::to_string(count) + " columns";
    if (columns_.are_named)
      refuse(found + " where " + std::to_string(columns_.count) + " are named", "correct it");
    refuse(found +
               ", and nothing says what those after x, y, z are: they may be points, or corners "
               "of boxes",
           "if they are points, name the columns in a first line, as: x y z intensity");
  }

  const std::string& name_;
  std::size_t line_number_ = 0;
  XyzColumns columns_;
  std::array<double, 3> point_{};
  PointCloud cloud_;
};

}  // namespace

PointCloud read_xyz(std::string_view bytes, const std::string& name) {
  return XyzReader(name).read(bytes);
}

}  // namespace ridgeway
