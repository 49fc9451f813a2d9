// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ridgeway/formats/point_cloud.hpp"

namespace ridgeway {

class Temporary;

/// A cloud as a range sensor recorded it from one place.
struct Scan {
  std::filesystem::path cloud;  ///< .xyz, .ply or .pcd, in the sensor's frame, its origin at 0
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();  ///< sensor to world, metres
};

/// A recording of scans, each with the pose of its sensor.
struct ScanSequence {
  std::string layout;            ///< "scans" or "registration"
  std::vector<Scan> scans;       ///< in the order of the file
  std::size_t without_pose = 0;  ///< scans whose pose is not finite, passed over
};

/// Whether open_scans() knows the layout of a folder.
bool holds_scans(const std::filesystem::path& folder);

/// Opens a folder of scans with known poses, in one of two layouts:
///
/// - poses.txt, a line for each scan: "cloud tx ty tz qx qy qz qw", the name of its file and the
///   pose of the sensor in the world (metres; rotation as a quaternion, as TUM trajectories have
///   it). Comments begin with "#"; names have no blanks. Scans whose pose is not finite are passed
///   over and counted.
/// - registration_metrics.json of a registration of scans to one of them, "reference". For each
///   name S in "scans" the cloud is S_raw.xyz, and for all but the reference R
///   "registration_to_R" has "transform_source_to_R" (R there without underscores), the rows of a
///   4 x 4 matrix from the frame of the scan to that of R, which is the world.
///
/// Throws InputError, with the file and the line or the key, for what is missing or wrong: clouds
/// that are not there or named twice, quaternions and matrices that are no rotations, a
/// registration that says that it was not accepted.
ScanSequence open_scans(const std::filesystem::path& folder);

/// The points of a scan. Throws InputError, naming the file, where they cannot be read.
PointCloud read_scan(const Scan& scan);

/// Writes scans and poses as a folder with poses.txt, clouds as binary .ply of single precision.
/// The folder must not exist or be empty; it appears whole, by finish(), or not at all.
class ScanWriter {
 public:
  /// Throws InputError where the folder is there and not empty, or cannot be made.
  explicit ScanWriter(const std::filesystem::path& folder);
  ~ScanWriter();
  ScanWriter(const ScanWriter&) = delete;
  ScanWriter& operator=(const ScanWriter&) = delete;
  /// Points in the sensor's frame, its origin at 0.
  void add(std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor);
  /// Puts the folder in its place. Throws InputError where that cannot be done, or nothing was
  /// added.
  void finish();

 private:
  std::filesystem::path folder_;
  std::unique_ptr<Temporary> temporary_;
  std::string poses_ = "# cloud tx ty tz qx qy qz qw\n";
  int count_ = 0;
};

}  // namespace ridgeway
