// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "unpacked_ridge.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "ridge/ridge_container.hpp"

namespace ridgeway::fuzz {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t kMostChunks = 64;

void append(std::string& text, std::uint32_t number) {
  char raw[sizeof(number)];
  std::memcpy(raw, &number, sizeof(number));
  text.append(raw, sizeof(number));
}

std::string_view take(std::string_view& bytes, std::size_t count) {
  const std::string_view taken = bytes.substr(0, std::min(count, bytes.size()));
  bytes.remove_prefix(taken.size());
  return taken;
}

std::uint32_t take_number(std::string_view& bytes) {
  std::uint32_t number = 0;
  const std::string_view raw = take(bytes, sizeof(number));
  std::memcpy(&number, raw.data(), raw.size());
  return number;
}

}  // namespace

std::string unpack_ridge(const std::filesystem::path& file) {
  const RidgeReader reader(file);
  RidgeReader::Scratch scratch;
  std::string text;
  append(text, static_cast<std::uint32_t>(reader.header().size()));
  text += reader.header();
  for (const RidgeSectionEntry& section : reader.sections()) {
    std::string name = section.name;
    name.resize(kSectionNameBytes);
    text += name;
    append(text, section.type);
    append(text, static_cast<std::uint32_t>(section.chunks.size()));
    for (std::size_t i = 0; i < section.chunks.size(); ++i) {
      Bytes raw;
      reader.read_chunk(section, i, scratch, raw);
      append(text, static_cast<std::uint32_t>(raw.size()));
      text.append(reinterpret_cast<const char*>(raw.data()), raw.size());
    }
  }
  return text;
}

void pack_ridge(std::string_view bytes, const std::filesystem::path& file) {
  const std::string_view header = take(bytes, take_number(bytes));
  std::vector<RidgeSectionSource> sections;
  while (!bytes.empty()) {
    const std::string_view padded = take(bytes, kSectionNameBytes);
    const std::string_view name = padded.substr(0, padded.find('\0'));
    const std::uint32_t type = take_number(bytes);
    std::vector<Bytes> chunks(std::min(take_number(bytes), kMostChunks));
    for (Bytes& chunk : chunks) {
      const std::string_view raw =
          take(bytes, std::min<std::size_t>(take_number(bytes), kLargestChunk));
      const auto* first = reinterpret_cast<const std::byte*>(raw.data());
      chunk.assign(first, first + raw.size());
    }
    sections.push_back({std::string(name), type, chunks.size(),
                        [chunks](std::size_t i, Bytes& raw) { raw = chunks[i]; }});
  }
  write_ridge_container(file, header, sections);
}

}  // namespace ridgeway::fuzz
