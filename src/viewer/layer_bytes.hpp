// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway::detail {

/// Numbers behind one another, little-endian.
template <typename Number>
void append(std::string& bytes, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void append_origin(std::string& bytes, const Point& world) {
  for (const double x : world) append(bytes, x);
}

inline std::uint32_t count_of(std::size_t count) { return static_cast<std::uint32_t>(count); }

inline Point map_origin(const EsdfMap& esdf) { return to_world(esdf, Point::Zero()); }

}  // namespace ridgeway::detail
