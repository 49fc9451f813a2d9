// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway::detail {

/// What was fused at one time: an image of a camera, or points where `points` says so.
struct LoggedScan {
  bool is_image = true;
  PinholeCamera camera;
  DepthImage image;
  std::vector<Point> points;  ///< in the sensor's frame
};

/// Keeps scans on disk, a file each, the oldest of which go where all would take too much room. The
/// files are removed with it. Throws InputError, naming the file, where the disk does not do.
class ScanLog {
 public:
  /// `folder`: to be made, or empty; `most_bytes`: of all files.
  ScanLog(std::filesystem::path folder, std::uint64_t most_bytes);
  ~ScanLog();
  ScanLog(const ScanLog&) = delete;
  ScanLog& operator=(const ScanLog&) = delete;

  void add(const DepthImage& image, const PinholeCamera& camera);
  void add(std::span<const Point> points);
  /// Takes the last one back.
  void drop_last() noexcept;
  void forget_oldest_if_full() noexcept;

  std::size_t size() const { return bytes_.size(); }  ///< of all that were added
  std::size_t first() const { return first_; }        ///< those before are gone
  LoggedScan read(std::size_t scan) const;

 private:
  std::filesystem::path file_of(std::size_t scan) const;
  void write(std::size_t scan, const std::string& bytes);
  bool remove(std::size_t scan) const noexcept;

  const std::filesystem::path folder_, lock_;
  const std::uint64_t most_bytes_;
  std::vector<std::uint64_t> bytes_;  // by scan
  std::uint64_t total_ = 0;
  std::size_t first_ = 0;
  bool made_folder_ = false;
};

}  // namespace ridgeway::detail
