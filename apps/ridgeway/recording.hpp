// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "console.hpp"
#include "ridgeway/formats/point_cloud.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway::cli {

enum class RecordingKind : std::uint8_t { kImages, kScans };

/// Throws InputError where a folder is no recording.
RecordingKind kind_of_recording(const std::string& folder);

/// What became of the points of scans.
struct PointCounts {
  std::size_t fused = 0;
  std::size_t out_of_range = 0;  ///< all others with finite coordinates
  std::size_t beyond = 0;        ///< of those the ones that free the way up to the largest range
  std::size_t not_finite = 0;

  void add(const PointCloud& cloud, const FusionConfig& config);
};

/// A note on points that show no surface, if there are any.
void note_points_without_surface(const Globals& globals, const PointCounts& points);

/// A note on frames without a pose, if there are any, and a warning of images that cannot be read.
void note_without_pose(const Globals& globals, std::size_t count, const std::string& layout);
void warn_of_unreadable(const Globals& globals, std::size_t count, const std::string& first);

/// Maps, pictures and heights take the world's z for up; recordings by hand often have another
/// axis, mostly that of the first image. Cameras are held upright more often than not: y is down.
/// What a person should be told where they are not upright in the world; else nothing.
std::string told_of_upward_axis(const DepthSequence& sequence);

/// A note where nobody named the camera's intrinsics: a map with wrong ones is bent.
void note_assumed_camera(const Globals& globals, const DepthSequence& sequence);

/// Throws InputError where a camera measures farther than a recording of its images holds.
void require_recordable(const DepthSensor& sensor);

/// Throws InputError where a file that is to be written is part of a recording.
void require_outside(const std::filesystem::path& output, const std::filesystem::path& folder);

}  // namespace ridgeway::cli
