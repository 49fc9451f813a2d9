// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <lzf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace ridgeway::testing {

using CloudPoint = std::array<double, 3>;

template <typename Value>
void append(std::string& bytes, Value value, bool turned = false) {
  std::array<char, sizeof(Value)> raw;
  std::memcpy(raw.data(), &value, sizeof(Value));
  if (turned) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

inline std::string text_of(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// A .pcd file with the fields intensity (1 byte), z (double), descriptor (3 shorts), x (float),
/// y (float or double).
inline std::string write_pcd(const std::vector<CloudPoint>& points, const std::string& data) {
  const std::string count = std::to_string(points.size());
  std::string file =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS intensity z descriptor x y\nSIZE 1 8 2 4 8\nTYPE U F I F F\nCOUNT 1 1 3 1 1\nWIDTH " +
      count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + data + "\n";
  if (data == "ascii") {
    for (const auto& [x, y, z] : points)
      file += "7 " + text_of(z) + " 1 2 3 " + text_of(x) + ' ' + text_of(y) + '\n';
    return file;
  }
  std::array<std::string, 5> columns;
  for (const auto& [x, y, z] : points) {
    std::array<std::string, 5> row;
    append(row[0], std::uint8_t{7});
    append(row[1], z);
    for (const int part : {1, 2, 3}) append(row[2], static_cast<std::int16_t>(part));
    append(row[3], static_cast<float>(x));
    append(row[4], y);
    for (std::size_t i = 0; i < 5; ++i) {
      if (data == "binary") file += row[i];
      columns[i] += row[i];
    }
  }
  if (data == "binary") return file;
  std::string all;
  for (const std::string& column : columns) all += column;
  std::string packed(2 * all.size() + 100, '\0');
  packed.resize(lzf_compress(all.data(), static_cast<unsigned>(all.size()), packed.data(),
                             static_cast<unsigned>(packed.size())));
  append(file, static_cast<std::uint32_t>(packed.size()));
  append(file, static_cast<std::uint32_t>(all.size()));
  return file + packed;
}

/// A .ply file whose vertices have other properties, lists too, and stand between other elements.
inline std::string write_ply(const std::vector<CloudPoint>& points, const std::string& format,
                             bool has_face = false) {
  std::string file = "ply\nformat " + format +
                     " 1.0\ncomment made by a test\nelement camera 2\nproperty float focal\n"
                     "element patch 2\nproperty list uchar int indices\nelement vertex " +
                     std::to_string(points.size()) +
                     "\nproperty uchar red\nproperty float x\nproperty list ushort short marks\n"
                     "property double y\nproperty float64 z\nelement face " +
                     (has_face ? "1" : "0") +
                     "\nproperty list uchar uint vertex_indices\nend_header\n";
  if (format == "ascii") {
    file += "0.5\n0.25\n2 4 5\n0\n";
    for (const auto& [x, y, z] : points)
      file += "255 " + text_of(x) + " 2 -1 -2 " + text_of(y) + ' ' + text_of(z) + '\n';
    return has_face ? file + "3 0 1 2\n" : file;
  }
  const bool turned = format == "binary_big_endian";
  append(file, 0.5f, turned);
  append(file, 0.25f, turned);
  append(file, std::uint8_t{2});
  append(file, std::int32_t{4}, turned);
  append(file, std::int32_t{5}, turned);
  append(file, std::uint8_t{0});
  for (const auto& [x, y, z] : points) {
    append(file, std::uint8_t{255});
    append(file, static_cast<float>(x), turned);
    append(file, std::uint16_t{2}, turned);
    append(file, std::int16_t{-1}, turned);
    append(file, std::int16_t{-2}, turned);
    append(file, y, turned);
    append(file, z, turned);
  }
  if (!has_face) return file;
  append(file, std::uint8_t{3});
  for (const std::uint32_t i : {0u, 1u, 2u}) append(file, i, turned);
  return file;
}

inline std::string write_xyz(const std::vector<CloudPoint>& points) {
  std::string file = "# x y z intensity\n";
  for (const auto& [x, y, z] : points)
    file += text_of(x) + ' ' + text_of(y) + ' ' + text_of(z) + " 12\n";
  return file;
}

/// A small tree by hand: a chain of inner nodes towards the lattice's lowest corner, ending in
/// seven free voxels and an occupied one.
inline std::string write_bt() {
  std::string data;
  const auto node = [&data](unsigned kinds) { append(data, static_cast<std::uint16_t>(kinds)); };
  constexpr unsigned inner = 3;
  for (int depth = 0; depth < 15; ++depth) node(inner);  // always child 0
  node(0b01'01'01'10'01'01'01'01);
  return "# Octomap OcTree binary file\n# a comment\nid OcTree\nsize 24\nres 0.1\ndata\n" + data;
}

/// The same tree as log-odds, with colours if asked to.
inline std::string write_ot(const std::string& id = "OcTree") {
  std::string data;
  const auto node = [&](float log_odds, std::uint8_t children) {
    append(data, log_odds);
    if (id == "ColorOcTree") data += "rgb";
    append(data, children);
  };
  for (int depth = 0; depth < 15; ++depth) node(2.0f, 1);
  node(2.0f, 255);
  for (int i = 0; i < 8; ++i) node(i == 4 ? 0.0f : -0.4f, 0);
  return "# Octomap OcTree file\nid " + id + "\nsize 24\nres 0.1\ndata\n" + data;
}

}  // namespace ridgeway::testing
