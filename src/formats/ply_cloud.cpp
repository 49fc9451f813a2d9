// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ply_cloud.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/byte_reader.hpp"
#include "files/text.hpp"
#include "scalar_type.hpp"

namespace ridgeway {
namespace {

constexpr const char* kCheckPlyHeader = "correct the header, or write the file again";

struct Property {
  std::string_view name;
  ScalarType type = ScalarType::kFloat32;
  std::optional<ScalarType> count_type = std::nullopt;  ///< set for lists
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const Property& p) { return p.count_type.has_value(); });
  }
  /// Bytes one takes, lists counting as empty; the least it can take.
  std::size_t least_bytes() const {
    std::size_t bytes = 0;
    for (const Property& p : properties) bytes += size_of(p.count_type.value_or(p.type));
    return bytes;
  }
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
};

ScalarType scalar_type(const ByteReader& reader, std::string_view word) {
  using enum ScalarType;
  static constexpr std::array<std::pair<std::string_view, ScalarType>, 16> names = {
      {{"char", kInt8},
       {"int8", kInt8},
       {"uchar", kUint8},
       {"uint8", kUint8},
       {"short", kInt16},
       {"int16", kInt16},
       {"ushort", kUint16},
       {"uint16", kUint16},
       {"int", kInt32},
       {"int32", kInt32},
       {"uint", kUint32},
       {"uint32", kUint32},
       {"float", kFloat32},
       {"float32", kFloat32},
       {"double", kFloat64},
       {"float64", kFloat64}}};
  for (const auto& [name, type] : names)
    if (word == name) return type;
  reader.fail("has a property of type '" + std::string(word.substr(0, 40)) + "'", kCheckPlyHeader);
}

Property read_property(const ByteReader& reader, std::string_view line) {
  Property property;
  std::string_view word = take_word(line);
  if (word == "list") {
    property.count_type = scalar_type(reader, take_word(line));
    word = take_word(line);
  }
  property.type = scalar_type(reader, word);
  property.name = take_word(line);
  return property;
}

Encoding read_encoding(const ByteReader& reader, std::string_view word) {
  if (word == "ascii") return Encoding::kAscii;
  if (word == "binary_little_endian") return Encoding::kLittleEndian;
  if (word == "binary_big_endian") return Encoding::kBigEndian;
  reader.fail("has the format '" + std::string(word.substr(0, 40)) + "'", kCheckPlyHeader);
}

PlyHeader read_ply_header(ByteReader& reader) {
  PlyHeader header;
  bool has_format = false;
  reader.take_line();  // "ply"
  while (true) {
    std::string_view line = reader.take_line();
    const std::string_view key = take_word(line);
    if (key == "end_header") break;
    if (key == "format") {
      header.encoding = read_encoding(reader, take_word(line));
      has_format = true;
    } else if (key == "element") {
      const std::string_view name = take_word(line);
      const auto count = to_number<std::uint64_t>(take_word(line));
      if (!count) reader.fail("does not say how many of an element it holds", kCheckPlyHeader);
      header.elements.push_back({name, *count, {}});
    } else if (key == "property") {
      if (header.elements.empty())
        reader.fail("has a property before any element", kCheckPlyHeader);
      header.elements.back().properties.push_back(read_property(reader, line));
    } else if (!key.empty() && key != "comment" && key != "obj_info") {
      reader.fail("has an unknown word in its header: " + std::string(key.substr(0, 40)),
                  kCheckPlyHeader);
    }
  }
  if (!has_format) reader.fail("says no format in its header", kCheckPlyHeader);
  return header;
}

/// Numbers of an ascii or binary body, one after the other.
class BodyReader {
 public:
  BodyReader(ByteReader& reader, Encoding encoding) : reader_(reader), encoding_(encoding) {}

  double take(ScalarType type) {
    if (encoding_ != Encoding::kAscii)
      return take_scalar(reader_, type, encoding_ == Encoding::kBigEndian);
    skip_blanks();
    std::string_view rest = reader_.rest();
    const std::size_t before = rest.size();
    double value = 0.0;
    if (rest.empty()) reader_.require(1);
    if (!take_number(rest, value) || !(rest.empty() || is_blank(rest[0]) || rest[0] == '\n'))
      reader_.fail("has something that is no number", "correct it");
    reader_.skip(before - rest.size());
    return value;
  }

  void skip_list(ScalarType count_type, ScalarType type) {
    const double count = take(count_type);
    if (!(count >= 0.0) || count > static_cast<double>(reader_.remaining()))
      reader_.fail("has a list of " + std::to_string(count) + " entries, more than fit",
                   kCheckPlyHeader);
    const auto entries = static_cast<std::size_t>(count);
    if (encoding_ != Encoding::kAscii) return reader_.skip(entries * size_of(type));
    for (std::size_t i = 0; i < entries; ++i) take(type);
  }

  /// Throws where the bytes left cannot hold an element.
  void require(const Element& element) {
    if (element.count == 0) return;
    if (element.properties.empty())
      reader_.fail("has an element without properties: " + std::string(element.name),
                   kCheckPlyHeader);
    const bool ascii = encoding_ == Encoding::kAscii;
    const std::size_t each = ascii ? 2 * element.properties.size() : element.least_bytes();
    if (element.count > (reader_.remaining() + (ascii ? 1 : 0)) / each) {
      reader_.fail("tells of " + std::to_string(element.count) + " of element " +
                       std::string(element.name) + ", but " + std::to_string(reader_.remaining()) +
                       " bytes are left",
                   "the file is cut short, fetch or write it again");
    }
  }

  void skip(const Element& element) {
    if (encoding_ != Encoding::kAscii && !element.has_lists())
      return reader_.skip(element.count * element.least_bytes());
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const Property& p : element.properties)
        p.count_type ? skip_list(*p.count_type, p.type) : static_cast<void>(take(p.type));
  }

  void require_end() {
    skip_blanks();
    if (reader_.remaining() > 0)
      reader_.fail(
          "goes on for " + std::to_string(reader_.remaining()) + " bytes after its last element",
          kCheckPlyHeader);
  }

 private:
  void skip_blanks() {
    const std::string_view rest = reader_.rest();
    std::size_t count = 0;
    while (count < rest.size() && (is_blank(rest[count]) || rest[count] == '\n')) ++count;
    reader_.skip(count);
  }

  ByteReader& reader_;
  Encoding encoding_;
};

/// Which of x, y, z a property is; 3 for none.
std::size_t axis_of(const Property& property) {
  static constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
  if (property.count_type) return 3;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), property.name) -
                                  names.begin());
}

void read_vertices(BodyReader& body, const Element& element, PointCloud& cloud) {
  std::vector<std::size_t> axes;
  for (const Property& property : element.properties) axes.push_back(axis_of(property));
  cloud.points.reserve(element.count);
  std::array<double, 4> value{};  // the last takes what is none of x, y, z
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < axes.size(); ++p) {
      const Property& property = element.properties[p];
      if (property.count_type)
        body.skip_list(*property.count_type, property.type);
      else
        value[axes[p]] = body.take(property.type);
    }
    cloud.add(value[0], value[1], value[2]);
  }
}

/// Polygons or strips of triangles, whatever their name.
bool has_faces(const Element& element) {
  return element.name == "face" || element.name == "tristrips" ||
         std::any_of(element.properties.begin(), element.properties.end(), [](const Property& p) {
           return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
         });
}

void require_coordinates(const ByteReader& reader, const PlyHeader& header) {
  std::array<bool, 4> found{};
  if (std::count_if(header.elements.begin(), header.elements.end(),
                    [](const Element& element) { return element.name == "vertex"; }) > 1)
    reader.fail("has more than one element vertex", kCheckPlyHeader);
  for (const Element& element : header.elements)
    if (element.name == "vertex")
      for (const Property& property : element.properties) found[axis_of(property)] = true;
  if (!found[0] || !found[1] || !found[2])
    reader.fail("has no element vertex with properties x, y and z",
                "write the cloud with all three");
}

}  // namespace

bool is_ply(std::string_view bytes) {
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n");
}

bool has_ply_faces(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  const PlyHeader header = read_ply_header(reader);
  return std::any_of(header.elements.begin(), header.elements.end(), [](const Element& element) {
    return has_faces(element) && element.count > 0;
  });
}

void require_one_list_of_faces(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  const PlyHeader header = read_ply_header(reader);
  int lists = 0;
  for (const Element& element : header.elements) {
    if (!has_faces(element) || element.count == 0) continue;
    if (element.name != "face")
      throw InputError(name, "has faces in the element '" + std::string(element.name) + "'",
                       "write them as polygons, in the element face");
    if (++lists > 1)
      throw InputError(name, "has more than one element face", "write all faces in one");
  }
}

PointCloud read_ply(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  const PlyHeader header = read_ply_header(reader);
  require_coordinates(reader, header);
  PointCloud cloud;
  BodyReader body(reader, header.encoding);
  for (const Element& element : header.elements) {
    body.require(element);
    if (has_faces(element)) cloud.faces += element.count;
    if (element.name == "vertex")
      read_vertices(body, element, cloud);
    else
      body.skip(element);
  }
  body.require_end();
  return cloud;
}

}  // namespace ridgeway
