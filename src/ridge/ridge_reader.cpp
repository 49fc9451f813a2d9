// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "crc32c.hpp"
#include "files/little_endian.hpp"
#include "ridge_container.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kPreambleBytes = 48;
constexpr std::size_t kEntryBytes = 40;
constexpr std::size_t kChunkBytes = 12;

constexpr const char* kCopyAgain = "copy the file again, or build the map again";

}  // namespace

struct RidgeReader::Scratch::Parts {
  ZSTD_DCtx* context = ZSTD_createDCtx();
  std::vector<std::byte> compressed;
  ~Parts() { ZSTD_freeDCtx(context); }
};
RidgeReader::Scratch::Scratch() : parts_(std::make_unique<Parts>()) {
  if (parts_->context == nullptr) throw std::bad_alloc();
}
RidgeReader::Scratch::~Scratch() = default;
RidgeReader::Scratch::Scratch(Scratch&&) noexcept = default;

RidgeReader::RidgeReader(const std::filesystem::path& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) {
    throw InputError(path_.string(), "cannot be opened: " + std::generic_category().message(errno),
                     "check the path and the permissions");
  }
  try {
    struct stat status = {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
      throw InputError(path_.string(), "is no regular file", "give a .ridge file");
    }
    file_bytes_ = static_cast<std::uint64_t>(status.st_size);

    const std::vector<std::byte> preamble = read_preamble();
    const auto section_count = number_at<std::uint32_t>(preamble, 12);
    const auto promised_bytes = number_at<std::uint64_t>(preamble, 16);
    const auto header_bytes = number_at<std::uint64_t>(preamble, 24);
    const auto directory_bytes = number_at<std::uint64_t>(preamble, 32);
    const std::uint64_t rest = file_bytes_ - kPreambleBytes;
    if (header_bytes > rest || directory_bytes > rest - header_bytes) {
      damaged("header", "is cut off");
    }
    std::vector<std::byte> front(header_bytes + directory_bytes);
    read_bytes(kPreambleBytes, front, "header");
    if (crc32c(front) != number_at<std::uint32_t>(preamble, 40)) {
      damaged("header", "is damaged (wrong checksum)");
    }
    header_.assign(reinterpret_cast<const char*>(front.data()), header_bytes);
    read_directory(std::span(front).subspan(header_bytes), section_count,
                   kPreambleBytes + front.size());
    check_extent(promised_bytes);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

RidgeReader::~RidgeReader() { ::close(descriptor_); }

std::vector<std::byte> RidgeReader::read_preamble() {
  std::vector<std::byte> preamble(std::min<std::uint64_t>(kPreambleBytes, file_bytes_));
  read_bytes(0, preamble, "preamble");
  if (preamble.size() < 12 || std::memcmp(preamble.data(), "RIDGEWAY", 8) != 0) {
    throw InputError(path_.string(), "is no .ridge file", "make one with `ridgeway build`");
  }
  version_ = number_at<std::uint32_t>(preamble, 8);
  if (version_ > kRidgeVersion) {
    throw InputError(path_.string(),
                     "was written by a newer version (format " + std::to_string(version_) +
                         ", this program reads up to " + std::to_string(kRidgeVersion) + ")",
                     "use a newer ridgeway, or build the map again with this one");
  }
  if (preamble.size() < kPreambleBytes) damaged("preamble", "is cut off");
  if (crc32c(std::span(preamble).first(44)) != number_at<std::uint32_t>(preamble, 44) ||
      version_ == 0) {
    damaged("preamble", "is damaged (wrong checksum)");
  }
  return preamble;
}

void RidgeReader::read_directory(std::span<const std::byte> directory, std::uint32_t section_count,
                                 std::uint64_t data_offset) {
  std::uint64_t offset = data_offset;
  for (std::uint32_t s = 0; s < section_count; ++s) {
    if (directory.size() < kEntryBytes) damaged("directory", "is cut off");
    RidgeSectionEntry entry;
    const char* name = reinterpret_cast<const char*>(directory.data());
    entry.name.assign(name, ::strnlen(name, kSectionNameBytes));
    entry.type = number_at<std::uint32_t>(directory, 16);
    const auto chunk_count = number_at<std::uint32_t>(directory, 20);
    entry.raw_bytes = number_at<std::uint64_t>(directory, 24);
    entry.compressed_bytes = number_at<std::uint64_t>(directory, 32);
    directory = directory.subspan(kEntryBytes);
    if (chunk_count > directory.size() / kChunkBytes) damaged("directory", "is cut off");
    std::uint64_t raw_bytes = 0, compressed_bytes = 0;
    for (std::uint32_t c = 0; c < chunk_count; ++c) {
      RidgeChunk chunk;
      chunk.raw_bytes = number_at<std::uint32_t>(directory, 0);
      chunk.compressed_bytes = number_at<std::uint32_t>(directory, 4);
      chunk.checksum = number_at<std::uint32_t>(directory, 8);
      chunk.offset = offset;
      if (chunk.raw_bytes > kLargestChunk ||
          chunk.compressed_bytes > ZSTD_compressBound(kLargestChunk)) {
        damaged(entry.name, "has a chunk of an impossible size");
      }
      offset += chunk.compressed_bytes;
      raw_bytes += chunk.raw_bytes;
      compressed_bytes += chunk.compressed_bytes;
      entry.chunks.push_back(chunk);
      directory = directory.subspan(kChunkBytes);
    }
    if (raw_bytes != entry.raw_bytes || compressed_bytes != entry.compressed_bytes) {
      damaged(entry.name, "has sizes that contradict each other");
    }
    sections_.push_back(std::move(entry));
  }
  if (!directory.empty()) damaged("directory", "has bytes that belong to no section");
}

void RidgeReader::check_extent(std::uint64_t promised_bytes) const {
  std::uint64_t end = file_bytes_ < promised_bytes ? file_bytes_ : promised_bytes;
  for (const RidgeSectionEntry& section : sections_) {
    for (const RidgeChunk& chunk : section.chunks) {
      if (chunk.offset + chunk.compressed_bytes > end) damaged(section.name, "is cut off");
    }
  }
  if (file_bytes_ != promised_bytes) {
    damaged("file", "has " + std::to_string(file_bytes_) + " bytes where " +
                        std::to_string(promised_bytes) + " were written");
  }
}

const RidgeSectionEntry& RidgeReader::get_section(std::string_view name, std::uint32_t type) const {
  for (const RidgeSectionEntry& section : sections_) {
    if (section.name != name) continue;
    if (section.type != type) damaged(name, "is of an unknown type");
    return section;
  }
  damaged(name, "is missing");
}

void RidgeReader::read_chunk(const RidgeSectionEntry& section, std::size_t index, Scratch& scratch,
                             std::vector<std::byte>& raw) const {
  const RidgeChunk& chunk = section.chunks.at(index);
  std::vector<std::byte>& compressed = scratch.parts_->compressed;
  compressed.resize(chunk.compressed_bytes);
  read_bytes(chunk.offset, compressed, section.name);
  if (crc32c(compressed) != chunk.checksum) damaged(section.name, "is damaged (wrong checksum)");
  raw.resize(chunk.raw_bytes);
  const std::size_t size = ZSTD_decompressDCtx(scratch.parts_->context, raw.data(), raw.size(),
                                               compressed.data(), compressed.size());
  if (ZSTD_isError(size) || size != raw.size()) damaged(section.name, "cannot be decompressed");
}

std::vector<std::byte> RidgeReader::read_all(const RidgeSectionEntry& section,
                                             std::uint64_t expected_bytes) const {
  if (section.raw_bytes != expected_bytes) {
    damaged(section.name, "has " + std::to_string(section.raw_bytes) + " bytes instead of " +
                              std::to_string(expected_bytes));
  }
  Scratch scratch;
  std::vector<std::byte> bytes, raw;
  for (std::size_t c = 0; c < section.chunks.size(); ++c) {
    read_chunk(section, c, scratch, raw);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  }
  return bytes;
}

void RidgeReader::damaged(std::string_view section, std::string_view what) const {
  throw InputError(path_.string(), "section '" + std::string(section) + "' " + std::string(what),
                   kCopyAgain);
}

void RidgeReader::read_bytes(std::uint64_t offset, std::span<std::byte> bytes,
                             std::string_view part) const {
  while (!bytes.empty()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw InputError(path_.string(), "cannot be read: " + std::generic_category().message(errno),
                       "check the disk");
    }
    if (got == 0) damaged(part, "is cut off");
    offset += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

}  // namespace ridgeway
