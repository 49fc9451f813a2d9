// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeway {

/// The outer layer of a `.ridge` file, which knows nothing of what the sections hold. All numbers
/// are little-endian.
///   48 bytes    magic "RIDGEWAY", u32 version, u32 sections, u64 file size, u64 header size,
///               u64 directory size, u32 checksum of header and directory, u32 of the 44 before
///   header      JSON text
///   directory   a section: name (16 bytes, zero-padded), u32 type, u32 chunks, u64 raw size,
///               u64 compressed size; then a chunk: u32 raw size, u32 compressed size, u32 checksum
///   data        the sections' chunks in the directory's order, each a zstd frame of its own
/// Checksums are CRC-32C, those of the chunks over the compressed bytes.
/// Files without limits, planes and free unknown space are of version 2, so that programs that know
/// of none of these read them.
inline constexpr std::uint32_t kRidgeVersion = 3;
inline constexpr std::uint32_t kRidgeVersionWithoutLimits = 2;
inline constexpr std::size_t kLargestChunk = std::size_t{1} << 22;
inline constexpr std::size_t kSectionNameBytes = 16;

struct RidgeChunk {
  std::uint32_t raw_bytes = 0;
  std::uint32_t compressed_bytes = 0;
  std::uint32_t checksum = 0;
  std::uint64_t offset = 0;  ///< in the file
};

struct RidgeSectionEntry {
  std::string name;
  std::uint32_t type = 0;
  std::uint64_t raw_bytes = 0;
  std::uint64_t compressed_bytes = 0;
  std::vector<RidgeChunk> chunks;
};

/// A section to be written: `fill(chunk, raw)` puts the bytes of a chunk into the empty `raw`; it
/// is called in parallel, once a chunk, and gives at most kLargestChunk bytes.
struct RidgeSectionSource {
  std::string name;  ///< at most 16 characters
  std::uint32_t type = 0;
  std::size_t chunk_count = 0;
  std::function<void(std::size_t chunk, std::vector<std::byte>& raw)> fill;
};

void write_ridge_container(const std::filesystem::path& path, std::string_view header,
                           std::span<const RidgeSectionSource> sections,
                           std::uint32_t version = kRidgeVersionWithoutLimits);

/// A source that hands out an array of bytes piece by piece.
RidgeSectionSource plain_section(std::string name, std::uint32_t type,
                                 std::vector<std::byte> bytes);

/// An open file whose header and directory have been checked: every chunk lies within the file.
class RidgeReader {
 public:
  explicit RidgeReader(const std::filesystem::path& path);
  ~RidgeReader();
  RidgeReader(const RidgeReader&) = delete;
  RidgeReader& operator=(const RidgeReader&) = delete;

  std::uint32_t version() const { return version_; }
  const std::string& header() const { return header_; }
  std::span<const RidgeSectionEntry> sections() const { return sections_; }
  std::string path() const { return path_.string(); }

  /// Throws InputError when there is no such section or it is of another type.
  const RidgeSectionEntry& get_section(std::string_view name, std::uint32_t type) const;

  /// What one thread needs for decompressing.
  class Scratch {
   public:
    Scratch();
    ~Scratch();
    Scratch(Scratch&&) noexcept;

   private:
    friend class RidgeReader;
    struct Parts;
    std::unique_ptr<Parts> parts_;
  };

  /// Reads and verifies one chunk. Thread-safe with a scratch for each thread.
  void read_chunk(const RidgeSectionEntry& section, std::size_t index, Scratch& scratch,
                  std::vector<std::byte>& raw) const;
  /// Reads all chunks of a section that must have `expected_bytes`.
  std::vector<std::byte> read_all(const RidgeSectionEntry& section,
                                  std::uint64_t expected_bytes) const;

  /// Throws the InputError for a section that is broken.
  [[noreturn]] void damaged(std::string_view section, std::string_view what) const;

 private:
  void read_bytes(std::uint64_t offset, std::span<std::byte> bytes, std::string_view part) const;
  std::vector<std::byte> read_preamble();
  void read_directory(std::span<const std::byte> directory, std::uint32_t section_count,
                      std::uint64_t data_offset);
  void check_extent(std::uint64_t promised_bytes) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t file_bytes_ = 0;
  std::uint32_t version_ = 0;
  std::string header_;
  std::vector<RidgeSectionEntry> sections_;
};

}  // namespace ridgeway
