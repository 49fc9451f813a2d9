// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

namespace ridgeway {

// What the reader and the writer of recordings agree on.
inline constexpr double kTumUnits = 5000.0;  // of an image, a metre
inline constexpr const char* kTumImages = "depth.txt";
inline constexpr const char* kTumPoses = "groundtruth.txt";
inline constexpr const char* kOpen3dPoses = "trajectory.log";
inline constexpr const char* kOpen3dImages = "depth";
inline constexpr const char* kIntrinsicsFile = "camera-intrinsics.txt";

}  // namespace ridgeway
