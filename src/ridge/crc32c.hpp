// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace ridgeway {

namespace detail {
/// Table k: what a byte that k more bytes follow adds to the checksum (Castagnoli polynomial,
/// reflected).
constexpr std::array<std::array<std::uint32_t, 256>, 8> crc32c_tables() {
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0x82f63b78u : 0u);
    tables[0][byte] = sum;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte)
      tables[k][byte] = tables[k - 1][byte] >> 8 ^ tables[0][tables[k - 1][byte] & 255];
  return tables;
}
inline constexpr auto kCrc32cTables = crc32c_tables();
}  // namespace detail

/// CRC-32C of the bytes: finds every burst of errors up to 32 bits. Eight bytes a step.
inline std::uint32_t crc32c(std::span<const std::byte> bytes) {
  const auto& t = detail::kCrc32cTables;
  std::uint32_t sum = 0xffffffffu;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    std::uint64_t word = 0;  // little-endian machines only, as the whole of this module
    std::memcpy(&word, bytes.data(), 8);
    word ^= sum;
    sum = t[7][word & 255] ^ t[6][word >> 8 & 255] ^ t[5][word >> 16 & 255] ^
          t[4][word >> 24 & 255] ^ t[3][word >> 32 & 255] ^ t[2][word >> 40 & 255] ^
          t[1][word >> 48 & 255] ^ t[0][word >> 56];
  }
  for (const std::byte b : bytes)
    sum = sum >> 8 ^ t[0][(sum ^ static_cast<std::uint32_t>(b)) & 255];
  return ~sum;
}

}  // namespace ridgeway
