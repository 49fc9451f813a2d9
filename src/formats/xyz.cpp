// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/xyz.hpp"

#include <array>

#include "files/byte_reader.hpp"
#include "files/text.hpp"

namespace ridgeway {
namespace {

void skip_separators(std::string_view& line) {
  while (!line.empty() && (is_blank(line[0]) || line[0] == ',' || line[0] == ';'))
    line.remove_prefix(1);
}

/// Three numbers, each ending where a separator or the line does.
bool take_point(std::string_view line, std::array<double, 3>& point) {
  for (double& coordinate : point) {
    skip_separators(line);
    if (!take_number(line, coordinate)) return false;
    if (!line.empty() && !is_blank(line[0]) && line[0] != ',' && line[0] != ';') return false;
  }
  return true;
}

bool names_columns(std::string_view line) {
  if (!line.empty() && line[0] == '"') line.remove_prefix(1);
  return !line.empty() && (line[0] == 'x' || line[0] == 'X');
}

}  // namespace

PointCloud read_xyz(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  cloud.points.reserve(bytes.size() / 24);
  std::array<double, 3> p{};
  std::size_t line_number = 0;
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // byte order mark
  for (ByteReader reader(bytes, name); reader.remaining() > 0;) {
    std::string_view line = reader.take_line();
    ++line_number;
    while (!line.empty() && is_blank(line[0])) line.remove_prefix(1);
    if (line.empty() || line[0] == '#' || line.starts_with("//")) continue;
    if (take_point(line, p)) {
      cloud.add(p[0], p[1], p[2]);
    } else if (!names_columns(line) || !cloud.points.empty()) {
      throw InputError(name, "line " + std::to_string(line_number) + " does not begin with x, y, z",
                       "give three numbers a line, separated by blanks or commas");
    }
  }
  return cloud;
}

}  // namespace ridgeway
