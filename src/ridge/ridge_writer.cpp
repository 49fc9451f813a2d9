// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

#include "crc32c.hpp"
#include "files/atomic_file.hpp"
#include "files/little_endian.hpp"
#include "ridge_container.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

constexpr int kCompressionLevel = 1;  // level 3 saves 6% of the file and takes twice as long
constexpr std::size_t kPlainChunk = std::size_t{1} << 18;

struct PackedChunk {
  std::uint32_t raw_bytes = 0;
  std::vector<std::byte> compressed;
};

PackedChunk pack(const std::vector<std::byte>& raw) {
  if (raw.size() > kLargestChunk) throw std::logic_error("chunk of a section is too large");
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  PackedChunk chunk;
  chunk.raw_bytes = static_cast<std::uint32_t>(raw.size());
  chunk.compressed.resize(ZSTD_compressBound(raw.size()));
  const std::size_t size = ZSTD_compress2(context.get(), chunk.compressed.data(),
                                          chunk.compressed.size(), raw.data(), raw.size());
  if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  chunk.compressed.resize(size);
  chunk.compressed.shrink_to_fit();
  return chunk;
}

std::vector<PackedChunk> pack_section(const RidgeSectionSource& source) {
  std::vector<PackedChunk> chunks(source.chunk_count);
  parallel_for_each_index(source.chunk_count, [&](std::size_t i) {
    std::vector<std::byte> raw;
    source.fill(i, raw);
    chunks[i] = pack(raw);
  });
  return chunks;
}

void append_directory_entry(std::vector<std::byte>& directory, const RidgeSectionSource& source,
                            const std::vector<PackedChunk>& chunks) {
  if (source.name.size() > kSectionNameBytes)
    throw std::logic_error("name of a section is too long");
  for (std::size_t i = 0; i < kSectionNameBytes; ++i)
    directory.push_back(static_cast<std::byte>(i < source.name.size() ? source.name[i] : '\0'));
  std::uint64_t raw_bytes = 0, compressed_bytes = 0;
  for (const PackedChunk& chunk : chunks) {
    raw_bytes += chunk.raw_bytes;
    compressed_bytes += chunk.compressed.size();
  }
  append_number(directory, source.type);
  append_number(directory, static_cast<std::uint32_t>(chunks.size()));
  append_number(directory, raw_bytes);
  append_number(directory, compressed_bytes);
  for (const PackedChunk& chunk : chunks) {
    append_number(directory, chunk.raw_bytes);
    append_number(directory, static_cast<std::uint32_t>(chunk.compressed.size()));
    append_number(directory, crc32c(chunk.compressed));
  }
}

std::vector<std::byte> make_preamble(std::uint32_t version, std::size_t section_count,
                                     std::uint64_t data_bytes, std::uint64_t header_bytes,
                                     std::span<const std::byte> header_and_directory) {
  std::vector<std::byte> preamble;
  for (const char c : std::string_view("RIDGEWAY")) preamble.push_back(static_cast<std::byte>(c));
  append_number(preamble, version);
  append_number(preamble, static_cast<std::uint32_t>(section_count));
  append_number(preamble, std::uint64_t{48} + header_and_directory.size() + data_bytes);
  append_number(preamble, header_bytes);
  append_number(preamble, header_and_directory.size() - header_bytes);
  append_number(preamble, crc32c(header_and_directory));
  append_number(preamble, crc32c(preamble));
  return preamble;
}

}  // namespace

void write_ridge_container(const std::filesystem::path& path, std::string_view header,
                           std::span<const RidgeSectionSource> sections, std::uint32_t version) {
  AtomicFile file(path);  // first, so that a bad path costs no time
  const auto header_raw = std::as_bytes(std::span(header));
  std::vector<std::byte> front(header_raw.begin(), header_raw.end());
  std::vector<std::vector<PackedChunk>> packed;
  std::uint64_t data_bytes = 0;
  for (const RidgeSectionSource& section : sections) {
    packed.push_back(pack_section(section));
    append_directory_entry(front, section, packed.back());
    for (const PackedChunk& chunk : packed.back()) data_bytes += chunk.compressed.size();
  }
  file.write(make_preamble(version, sections.size(), data_bytes, header.size(), front));
  file.write(front);
  for (const auto& chunks : packed)
    for (const PackedChunk& chunk : chunks) file.write(chunk.compressed);
  file.commit();
}

RidgeSectionSource plain_section(std::string name, std::uint32_t type,
                                 std::vector<std::byte> bytes) {
  const std::size_t count = (bytes.size() + kPlainChunk - 1) / kPlainChunk;
  auto fill = [bytes = std::move(bytes)](std::size_t chunk, std::vector<std::byte>& raw) {
    const std::size_t begin = chunk * kPlainChunk;
    const std::size_t end = std::min(bytes.size(), begin + kPlainChunk);
    raw.assign(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
               bytes.begin() + static_cast<std::ptrdiff_t>(end));
  };
  return {std::move(name), type, count, std::move(fill)};
}

}  // namespace ridgeway
