// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/planning/check.hpp"
#include "sensing/poses.hpp"

namespace ridgeway {

/// How fast scans are fused, and how well. Lengths in metres.
struct FusionSpeedConfig {
  double voxel_size = 0.1;
  double truncation = 0.4;
  double sigma = 0.0;       ///< noise of every range
  PoseSampling poses = {};  ///< of the camera
  std::uint64_t seed = 1;   ///< of the noise

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// One way to fuse the same scans.
struct FusionSpeed {
  std::string integrator;  ///< "projective", "rays", "plain voxels" or "plain rays"
  Spread milliseconds;     ///< of a scan
  std::size_t voxels = 0;  ///< that say they are nearer to a surface than the truncation
  Spread error;            ///< of those, off the exact distance, voxels
  double mean_error = 0.0;
};

/// Fuses the same scans with both integrators and with two plain loops on one thread, as a text
/// book has them, which are the baselines: "plain voxels" looks up for every voxel of the box
/// around what a camera sees the pixel that it falls on; "plain rays" updates for every pixel the
/// voxels on its ray in a hash table of voxels. Both measure along the ray.
std::vector<FusionSpeed> run_fusion_speed(const World& world, const FusionSpeedConfig& config,
                                          const Progress& progress = {});
/// The same; where it is cancelled the results are those that were done.
void run_fusion_speed(const World& world, const FusionSpeedConfig& config, const Progress& progress,
                      std::vector<FusionSpeed>& results);

}  // namespace ridgeway
