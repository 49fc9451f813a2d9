// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "files/byte_reader.hpp"

namespace ridgeway {

/// A number of seven bits a byte, the lowest first. Throws InputError, by the reader, for one that
/// is cut off or longer than ten bytes.
inline std::uint64_t take_varint(ByteReader& reader) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 70; shift += 7) {
    const auto byte = reader.take<std::uint8_t>();
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  reader.fail("has a number of more than ten bytes", "the file is damaged, write it again");
}

/// A field of a protobuf message: its number, and its value by its wire type.
struct ProtobufField {
  enum Wire : std::uint8_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };
  std::uint32_t number = 0;
  Wire wire = kVarint;
  std::uint64_t bits = 0;          ///< of a varint or fixed value
  std::size_t begin = 0, end = 0;  ///< of kBytes: where in the file they lie

  double as_double() const { return std::bit_cast<double>(bits); }
  float as_float() const { return std::bit_cast<float>(static_cast<std::uint32_t>(bits)); }
  std::int64_t as_signed() const { return static_cast<std::int64_t>(bits); }
};

/// The next field of a message. Throws InputError for one that is cut off.
inline ProtobufField take_field(ByteReader& reader) {
  const std::uint64_t tag = take_varint(reader);
  ProtobufField field;
  field.number = static_cast<std::uint32_t>(tag >> 3);
  field.wire = static_cast<ProtobufField::Wire>(tag & 7);
  switch (field.wire) {
    case ProtobufField::kVarint:
      field.bits = take_varint(reader);
      return field;
    case ProtobufField::kFixed64:
      field.bits = reader.take<std::uint64_t>();
      return field;
    case ProtobufField::kFixed32:
      field.bits = reader.take<std::uint32_t>();
      return field;
    case ProtobufField::kBytes: {
      const std::uint64_t length = take_varint(reader);
      if (length > reader.remaining()) reader.require(reader.remaining() + 1);
      field.begin = reader.offset();
      reader.skip(length);
      field.end = reader.offset();
      return field;
    }
  }
  reader.fail("has a field of a wire type that is none", "the file is damaged, write it again");
}

/// Appends the fields of a message, in the order in which they are given.
class ProtobufWriter {
 public:
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<char>((value & 0x7f) | 0x80));
    bytes_.push_back(static_cast<char>(value));
  }
  void whole(std::uint32_t number, std::uint64_t value) {
    varint(number << 3 | ProtobufField::kVarint);
    varint(value);
  }
  void real(std::uint32_t number, double value) {
    varint(number << 3 | ProtobufField::kFixed64);
    fixed(std::bit_cast<std::uint64_t>(value), 8);
  }
  void single(std::uint32_t number, float value) {
    varint(number << 3 | ProtobufField::kFixed32);
    fixed(std::bit_cast<std::uint32_t>(value), 4);
  }
  void text(std::uint32_t number, std::string_view value) {
    varint(number << 3 | ProtobufField::kBytes);
    message(value);
  }
  /// Length and bytes, without a field's number.
  void message(std::string_view value) {
    varint(value.size());
    bytes_.append(value);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void fixed(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
  std::string bytes_;
};

}  // namespace ridgeway
