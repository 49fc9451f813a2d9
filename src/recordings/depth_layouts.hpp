// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>

#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway {

// What the reader and the writer of recordings agree on.
inline constexpr double kTumUnits = 5000.0;  // of an image, a metre
inline constexpr const char* kTumImages = "depth.txt";
inline constexpr const char* kTumPoses = "groundtruth.txt";
inline constexpr const char* kOpen3dPoses = "trajectory.log";
inline constexpr const char* kOpen3dImages = "depth";
inline constexpr const char* kIntrinsicsFile = "camera-intrinsics.txt";

// The frames of a folder in each layout, without the camera. Throw InputError, with the file and
// the line, for what is missing or wrong.

/// TUM RGB-D: depth.txt and groundtruth.txt.
DepthSequence open_tum(const std::filesystem::path& folder, const SequenceConfig& config);

/// 7-Scenes and 3DMatch: frame-*.depth.png with frame-*.pose.txt.
bool holds_seven_scenes(const std::filesystem::path& folder);
DepthSequence open_seven_scenes(const std::filesystem::path& folder);

/// Open3D and Redwood: depth/*.png beside trajectory.log.
bool holds_log(const std::filesystem::path& folder);
DepthSequence open_log(const std::filesystem::path& folder, const SequenceConfig& config);

}  // namespace ridgeway
