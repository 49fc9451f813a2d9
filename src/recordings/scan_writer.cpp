// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <array>
#include <bit>

#include "files/atomic_file.hpp"
#include "recording_folder.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"

namespace ridgeway {

ScanWriter::ScanWriter(const std::filesystem::path& folder) {
  temporary_ = begin_folder(folder, "clouds", folder_);
}

ScanWriter::~ScanWriter() = default;

void ScanWriter::add(std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor) {
  static_assert(std::endian::native == std::endian::little);
  const std::string name = numbered("clouds/", count_++, ".ply");
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(points.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const Point& point : points) {
    const Eigen::Vector3f p = point.cast<float>();
    bytes.append(std::bit_cast<std::array<char, 12>>(std::array{p.x(), p.y(), p.z()}).data(), 12);
  }
  write_text_file(temporary_->path() / name, bytes);
  poses_ += name + " " + pose_text(T_world_sensor) + "\n";
}

void ScanWriter::finish() {
  if (count_ == 0) throw InputError(folder_.string(), "has no scan yet", "add one first");
  write_text_file(temporary_->path() / "poses.txt", poses_);
  finish_folder(*temporary_, folder_);
}

}  // namespace ridgeway
