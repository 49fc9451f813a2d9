// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "scan_log.hpp"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "files/byte_reader.hpp"
#include "files/read_file.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway::detail {
namespace {

namespace fs = std::filesystem;

template <typename Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

ScanLog::ScanLog(fs::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), lock_(folder_ / "in-use"), most_bytes_(most_bytes) {
  std::error_code error;
  made_folder_ = fs::create_directories(folder_, error);
  const bool is_empty = !error && fs::is_directory(folder_, error) && fs::is_empty(folder_, error);
  if (!is_empty)
    throw InputError(folder_.string(), "is no folder that scans can be kept in",
                     "give one that is new or empty, on a disk with room");
  // Two logs may both have found it empty.
  std::FILE* lock = std::fopen(lock_.c_str(), "wx");
  if (lock == nullptr && made_folder_) fs::remove(folder_, error);  // unless it is another's by now
  if (lock == nullptr)
    throw InputError(folder_.string(), "is another roadmap's, or cannot be written to",
                     "give each its own");
  std::fclose(lock);
}

ScanLog::~ScanLog() {
  for (std::size_t scan = first_; scan <= size(); ++scan)
    remove(scan);  // one may be left of a drop
  std::error_code error;
  fs::remove(lock_, error);
  if (made_folder_) fs::remove(folder_, error);
}

/// False where there was no memory to do so.
bool ScanLog::remove(std::size_t scan) const noexcept {
  try {
    std::error_code error;
    fs::remove(file_of(scan), error);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

fs::path ScanLog::file_of(std::size_t scan) const {
  return folder_ / ("scan-" + std::to_string(scan + 1) + ".bin");
}

void ScanLog::add(const DepthImage& image, const PinholeCamera& camera) {
  std::string bytes;
  append(bytes, std::uint64_t{1});
  append(bytes, camera);
  bytes.append(reinterpret_cast<const char*>(image.depth.data()),
               image.depth.size() * sizeof(image.depth[0]));
  write(size(), bytes);
}

void ScanLog::add(std::span<const Point> points) {
  std::string bytes;
  append(bytes, std::uint64_t{0});
  for (const Point& p : points) append(bytes, std::array{p.x(), p.y(), p.z()});
  write(size(), bytes);
}

void ScanLog::write(std::size_t scan, const std::string& bytes) {
  if (bytes_.size() == bytes_.capacity()) bytes_.reserve(2 * scan + 1);
  std::ofstream file(file_of(scan), std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    std::error_code error;
    fs::remove(file_of(scan), error);
    throw InputError(file_of(scan).string(), "cannot be written",
                     "give a folder on a disk with room, or a smaller bound");
  }
  bytes_.push_back(bytes.size());
  total_ += bytes.size();
}

void ScanLog::drop_last() noexcept {
  remove(size() - 1);  // else the next one writes over it
  total_ -= bytes_.back();
  bytes_.pop_back();
}

void ScanLog::forget_oldest_if_full() noexcept {
  for (; total_ > most_bytes_ && first_ < size() && remove(first_); ++first_)
    total_ -= bytes_[first_];
}

LoggedScan ScanLog::read(std::size_t scan) const {
  const std::string bytes = read_file(file_of(scan));
  ByteReader reader(bytes, file_of(scan).string());
  LoggedScan logged;
  logged.is_image = reader.take<std::uint64_t>() == 1;
  if (logged.is_image) {
    logged.camera = reader.take<PinholeCamera>();
    logged.image.width = logged.camera.width;
    logged.image.height = logged.camera.height;
    logged.image.depth.resize(reader.remaining() / sizeof(logged.image.depth[0]));
    std::memcpy(logged.image.depth.data(), reader.rest().data(),
                logged.image.depth.size() * sizeof(logged.image.depth[0]));
    return logged;
  }
  while (reader.remaining() > 0) {
    const auto p = reader.take<std::array<double, 3>>();
    logged.points.emplace_back(p[0], p[1], p[2]);
  }
  return logged;
}

}  // namespace ridgeway::detail
