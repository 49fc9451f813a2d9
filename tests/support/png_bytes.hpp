// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeway {

/// What the header of a PNG file says, true or not.
struct PngHeader {
  std::uint32_t width = 64, height = 48;
  int bits = 16, colour = 0, interlaced = 0;  ///< colour: 0 grey, 2 RGB, 3 palette, 4 grey + alpha
};

inline std::string png_chunk(const char* type, const std::string& data) {
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const std::string body = type + data;
  const auto sum =
      ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return number(static_cast<std::uint32_t>(data.size())) + body +
         number(static_cast<std::uint32_t>(sum));
}

/// A PNG file with a header and so many zero bytes for its rows.
inline std::string png_bytes(const PngHeader& header, std::size_t row_bytes) {
  std::string start(13, '\0');
  for (int i = 0; i < 4; ++i) {
    start[static_cast<std::size_t>(i)] = static_cast<char>(header.width >> (24 - 8 * i));
    start[static_cast<std::size_t>(4 + i)] = static_cast<char>(header.height >> (24 - 8 * i));
  }
  start[8] = static_cast<char>(header.bits);
  start[9] = static_cast<char>(header.colour);
  start[12] = static_cast<char>(header.interlaced);
  const std::vector<Bytef> rows(row_bytes, 0);
  uLongf size = ::compressBound(row_bytes);
  std::string packed(size, '\0');
  ::compress(reinterpret_cast<Bytef*>(packed.data()), &size, rows.data(), row_bytes);
  packed.resize(size);
  const std::string palette = header.colour == 3 ? png_chunk("PLTE", std::string(768, '\7')) : "";
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", start) + palette + png_chunk("IDAT", packed) +
         png_chunk("IEND", "");
}

}  // namespace ridgeway
