// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "pcd.hpp"

#include <lzf.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "files/byte_reader.hpp"
#include "files/text.hpp"
#include "mapping/memory_limit.hpp"
#include "scalar_type.hpp"

namespace ridgeway {
namespace {

constexpr const char* kCheckPcdHeader = "correct the header, or write the file again";
constexpr std::size_t kMaxRecord = 1 << 20;  // bytes a point; bounds all sums below

struct Field {
  std::string_view name;
  std::size_t size = 4;
  char type = 'F';
  std::size_t count = 1;
};

struct Coordinate {
  std::size_t field = 0;         ///< its place in the list of fields
  std::size_t first_column = 0;  ///< ascii
  std::size_t offset = 0;        ///< bytes before it in a point
  ScalarType type = ScalarType::kFloat32;
};

struct PcdHeader {
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::string_view data;
  std::array<Coordinate, 3> xyz;
  std::size_t columns = 0;
  std::size_t record = 0;  ///< bytes a point
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
  return words;
}

ScalarType scalar_type(const ByteReader& reader, const Field& field) {
  const bool is_signed = field.type == 'I';
  if (field.type == 'F') {
    if (field.size == 4) return ScalarType::kFloat32;
    if (field.size == 8) return ScalarType::kFloat64;
  } else if (field.type == 'I' || field.type == 'U') {
    if (field.size == 1) return is_signed ? ScalarType::kInt8 : ScalarType::kUint8;
    if (field.size == 2) return is_signed ? ScalarType::kInt16 : ScalarType::kUint16;
    if (field.size == 4) return is_signed ? ScalarType::kInt32 : ScalarType::kUint32;
    if (field.size == 8) return is_signed ? ScalarType::kInt64 : ScalarType::kUint64;
  }
  reader.fail("gives field " + std::string(field.name) + " the type " + field.type +
                  std::to_string(field.size),
              kCheckPcdHeader);
}

/// One number a field, as in SIZE and COUNT.
void take_sizes(const ByteReader& reader, const std::vector<std::string_view>& words,
                std::vector<Field>& fields, std::size_t Field::*member) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = to_number<std::size_t>(words[i + 1]);
    if (!value || *value == 0 || *value > kMaxRecord)
      reader.fail("has '" + std::string(words[i + 1]) + "' for a " + std::string(words[0]),
                  kCheckPcdHeader);
    fields[i].*member = *value;
  }
}

void place_coordinates(const ByteReader& reader, PcdHeader& header) {
  std::array<bool, 3> found{};
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const Field& field = header.fields[i];
    if (field.name.size() == 1 && field.name[0] >= 'x' && field.name[0] <= 'z' &&
        field.count == 1) {
      const auto axis = static_cast<std::size_t>(field.name[0] - 'x');
      header.xyz[axis] = {i, header.columns, header.record, scalar_type(reader, field)};
      found[axis] = true;
    }
    header.columns += field.count;
    header.record += field.size * field.count;
    if (header.record > kMaxRecord) reader.fail("has more than 1 MB a point", kCheckPcdHeader);
  }
  if (!found[0] || !found[1] || !found[2])
    reader.fail("has no fields x, y and z", "write the cloud with all three");
}

PcdHeader read_pcd_header(ByteReader& reader) {
  PcdHeader header;
  std::optional<std::uint64_t> width, height, points;
  const auto number = [&reader](std::string_view word, std::uint64_t most) {
    const auto value = to_number<std::uint64_t>(word);
    if (!value || *value > most)
      reader.fail("has '" + std::string(word) + "' for a number of points", kCheckPcdHeader);
    return *value;
  };
  while (header.data.empty()) {
    const std::vector<std::string_view> words = words_of(reader.take_line());
    if (words.empty() || words[0][0] == '#') continue;
    const std::string_view key = words[0];
    const bool per_field = key == "SIZE" || key == "TYPE" || key == "COUNT";
    if (words.size() < 2 || (per_field && words.size() != header.fields.size() + 1))
      reader.fail("has the wrong number of words after " + std::string(key), kCheckPcdHeader);
    if (key == "FIELDS" || key == "COLUMNS") {
      header.fields.clear();
      for (std::size_t i = 1; i < words.size(); ++i) header.fields.push_back({.name = words[i]});
    } else if (key == "SIZE") {
      take_sizes(reader, words, header.fields, &Field::size);
    } else if (key == "COUNT") {
      take_sizes(reader, words, header.fields, &Field::count);
    } else if (key == "TYPE") {
      for (std::size_t i = 0; i < header.fields.size(); ++i)
        header.fields[i].type = words[i + 1][0];
    } else if (key == "WIDTH") {
      width = number(words[1], 1ull << 31);
    } else if (key == "HEIGHT") {
      height = number(words[1], 1ull << 31);
    } else if (key == "POINTS") {
      points = number(words[1], 1ull << 62);
    } else if (key == "DATA") {
      header.data = words[1];
    } else if (key != "VERSION" && key != "VIEWPOINT") {
      reader.fail("has an unknown word in its header: " + std::string(key.substr(0, 40)),
                  kCheckPcdHeader);
    }
  }
  if (!points && !width) reader.fail("says neither POINTS nor WIDTH", kCheckPcdHeader);
  const std::uint64_t area = width ? *width * height.value_or(1) : *points;
  header.points = points.value_or(area);
  if (header.points != area)
    reader.fail("has POINTS other than WIDTH times HEIGHT", kCheckPcdHeader);
  place_coordinates(reader, header);
  return header;
}

/// Only what some writers pad with may follow the last point.
void require_end(const ByteReader& reader) {
  const std::string_view rest = reader.rest();
  if (std::any_of(rest.begin(), rest.end(),
                  [](char c) { return c != '\0' && c != '\n' && !is_blank(c); }))
    reader.fail("goes on for " + std::to_string(rest.size()) + " bytes after its last point",
                kCheckPcdHeader);
}

/// Throws where the bytes cannot hold the points that the header tells of.
void require_points(const ByteReader& reader, std::uint64_t points, std::size_t bytes_each) {
  if (points > reader.remaining() / bytes_each) {
    reader.fail("tells of " + std::to_string(points) + " points, but " +
                    std::to_string(reader.remaining()) + " bytes are left",
                "the file is cut short, fetch or write it again");
  }
}

PointCloud read_ascii(ByteReader& reader, const PcdHeader& header) {
  PointCloud cloud;
  // The last line may lack its end.
  require_points(reader, header.points == 0 ? 0 : header.points - 1, 2 * header.columns);
  cloud.points.reserve(header.points);
  std::array<double, 3> p{};
  for (std::uint64_t point = 0; point < header.points;) {
    std::string_view line = reader.take_line();
    std::size_t column = 0;
    for (auto word = take_word(line); !word.empty(); word = take_word(line), ++column) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (header.xyz[axis].first_column != column) continue;
        if (!take_number(word, p[axis]) || !word.empty())
          reader.fail("has a coordinate that is no number in point " + std::to_string(point + 1),
                      "correct it");
      }
    }
    if (column == 0) continue;  // an empty line
    ++point;
    if (column != header.columns) {
      reader.fail("has " + std::to_string(column) + " columns in point " + std::to_string(point) +
                      " where its header says " + std::to_string(header.columns),
                  "the file is cut short or its header is wrong");
    }
    cloud.add(p[0], p[1], p[2]);
  }
  require_end(reader);
  return cloud;
}

PointCloud read_binary(ByteReader& reader, const PcdHeader& header) {
  require_points(reader, header.points, header.record);
  PointCloud cloud;
  cloud.points.reserve(header.points);
  std::array<double, 3> p{};
  for (std::uint64_t point = 0; point < header.points; ++point) {
    const std::size_t begin = reader.offset();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reader.move_to(begin + header.xyz[axis].offset);
      p[axis] = take_scalar(reader, header.xyz[axis].type);
    }
    cloud.add(p[0], p[1], p[2]);
    reader.move_to(begin + header.record);
  }
  require_end(reader);
  return cloud;
}

/// Two sizes, then LZF of all values of the first field, all of the second, and so on.
PointCloud read_compressed(ByteReader& reader, const PcdHeader& header) {
  constexpr std::size_t most_gain = 100;  // LZF makes at most 264 bytes of 3
  if (header.points == 0) return {};
  const std::size_t packed = reader.take<std::uint32_t>();
  const std::size_t unpacked = reader.take<std::uint32_t>();
  reader.require(packed);
  if (header.points > unpacked / header.record || unpacked != header.points * header.record)
    reader.fail("unpacks to " + std::to_string(unpacked) + " bytes, not to its points",
                kCheckPcdHeader);
  if (unpacked / most_gain > packed) reader.fail("is too short for its points", kCheckPcdHeader);
  require_memory(static_cast<double>(unpacked) +
                     static_cast<double>(sizeof(Point)) * static_cast<double>(header.points),
                 reader.name(), "take fewer points");
  std::string values(unpacked, '\0');
  if (lzf_decompress(reader.rest().data(), static_cast<unsigned>(packed), values.data(),
                     static_cast<unsigned>(unpacked)) != unpacked)
    reader.fail("has damaged compressed data", "the file is damaged, fetch or write it again");
  reader.skip(packed);
  require_end(reader);

  PointCloud cloud;
  cloud.points.reserve(header.points);
  std::vector<ByteReader> columns;
  for (const Coordinate& c : header.xyz)
    columns.emplace_back(values, reader.name(), c.offset * header.points);
  for (std::uint64_t point = 0; point < header.points; ++point) {
    const double x = take_scalar(columns[0], header.xyz[0].type);
    const double y = take_scalar(columns[1], header.xyz[1].type);
    const double z = take_scalar(columns[2], header.xyz[2].type);
    cloud.add(x, y, z);
  }
  return cloud;
}

}  // namespace

bool is_pcd(std::string_view bytes) {
  while (bytes.starts_with("#"))
    bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size() - 1) + 1);
  return bytes.starts_with("VERSION .") || bytes.starts_with("VERSION 0.") ||
         bytes.starts_with("FIELDS ");
}

PointCloud read_pcd(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  const PcdHeader header = read_pcd_header(reader);
  if (header.data == "ascii") return read_ascii(reader, header);
  if (header.data == "binary") return read_binary(reader, header);
  if (header.data == "binary_compressed") return read_compressed(reader, header);
  reader.fail("has its data as '" + std::string(header.data.substr(0, 40)) + "'",
              "ascii, binary and binary_compressed can be read");
}

}  // namespace ridgeway
