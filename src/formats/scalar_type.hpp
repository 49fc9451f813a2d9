// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "files/byte_reader.hpp"

namespace ridgeway {

/// Number types of point files.
enum class ScalarType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

inline std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
    case ScalarType::kUint8:
      return 1;
    case ScalarType::kInt16:
    case ScalarType::kUint16:
      return 2;
    case ScalarType::kInt32:
    case ScalarType::kUint32:
    case ScalarType::kFloat32:
      return 4;
    default:
      return 8;
  }
}

/// The next number, whatever its type; `turned` where its byte order is not the machine's.
inline double take_scalar(ByteReader& reader, ScalarType type, bool turned = false) {
  switch (type) {
    case ScalarType::kInt8:
      return reader.take<std::int8_t>();
    case ScalarType::kUint8:
      return reader.take<std::uint8_t>();
    case ScalarType::kInt16:
      return reader.take<std::int16_t>(turned);
    case ScalarType::kUint16:
      return reader.take<std::uint16_t>(turned);
    case ScalarType::kInt32:
      return reader.take<std::int32_t>(turned);
    case ScalarType::kUint32:
      return reader.take<std::uint32_t>(turned);
    case ScalarType::kInt64:
      return static_cast<double>(reader.take<std::int64_t>(turned));
    case ScalarType::kUint64:
      return static_cast<double>(reader.take<std::uint64_t>(turned));
    case ScalarType::kFloat32:
      return static_cast<double>(reader.take<float>(turned));
    case ScalarType::kFloat64:
      break;
  }
  return reader.take<double>(turned);
}

}  // namespace ridgeway
