// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway {

class Temporary;

/// One image of a recording, and where the camera was.
struct DepthFrame {
  std::filesystem::path image;                                       ///< 16-bit PNG
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  ///< camera to world, metres
  std::optional<double> time = {};  ///< seconds, by the recording's clock, where it has one
};

/// A recording: depth images with poses, in the order of time. The images are read when needed.
struct DepthSequence {
  std::string layout;               ///< "tum", "7-scenes" or "open3d"
  PinholeCamera camera;             ///< of all images
  bool is_camera_assumed = false;   ///< nobody named its intrinsics: they are the layout's
  double units_per_metre = 5000.0;  ///< of the images
  std::vector<DepthFrame> frames;   ///< in the order of time
  std::size_t without_pose = 0;     ///< images that no pose belongs to, passed over
  /// Time of the last pose: what is later may get another one when the recording grows (TUM).
  double poses_until = std::numeric_limits<double>::infinity();
};

/// What a recording of depth images does not say of itself.
struct SequenceConfig {
  /// fx, fy, cx, cy in pixels; else those of camera-intrinsics.txt in the folder, else, for images
  /// of 640 x 480, the defaults of the layout (525, 525, 319.5, 239.5; of 7-Scenes 585, 585, 320,
  /// 240).
  std::optional<Eigen::Vector4d> intrinsics = {};
  /// An image between two poses that are no more seconds apart than this has the pose between
  /// them: on the line, turning evenly (TUM). 0: none has.
  double longest_step = 0.2;
  double longest_gap = 0.02;  ///< seconds between any other image and its pose (TUM)
  /// The folder is still written to, in order: at its end lines and poses that are not whole are
  /// left out, and images and poses that the other is not there for yet (Open3D).
  bool is_growing = false;
};

/// Whether open_sequence() knows the layout of a folder.
bool holds_depth_images(const std::filesystem::path& folder);

/// Opens a folder in the layout of TUM RGB-D (depth.txt, groundtruth.txt, images of 1/5000 m; an
/// image between two poses has the pose between them, the other images are matched with the nearest
/// pose, nearest first, each pose once: SequenceConfig), of 7-Scenes and 3DMatch (frame-*.depth.png
/// in millimetres with frame-*.pose.txt, 4 x 4, camera to world), or of Open3D and Redwood
/// (depth/*.png in millimetres with trajectory.log, one pose for each image, in the order of the
/// numbers in their names). Throws InputError, with the file and the line, for what is missing or
/// wrong; poses that are not finite ("lost") are passed over and counted. The camera has the size
/// of the first image that can be read.
DepthSequence open_sequence(const std::filesystem::path& folder, const SequenceConfig& config = {});

/// The image of a frame. Throws InputError where it cannot be read. Its size is as it is: fusion
/// refuses one that does not fit the camera.
DepthImage read_frame(const DepthSequence& sequence, const DepthFrame& frame);

/// Writes depth images and poses as a folder in the layout of TUM RGB-D, with the camera in
/// camera-intrinsics.txt. The folder must not exist or be empty; it appears whole, by finish(), or
/// not at all.
class SequenceWriter {
 public:
  /// Metres along the optical axis: what is farther does not fit the layout's images, and is
  /// written as not measured.
  static constexpr double kFarthest = 13.1;

  /// `rate`: images a second, which gives their times. Throws InputError where the folder is there
  /// and not empty, or cannot be made, or the rate is not positive and finite.
  SequenceWriter(const std::filesystem::path& folder, const PinholeCamera& camera,
                 double rate = 10.0);
  ~SequenceWriter();
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;
  /// Appends an image and its pose (camera to world, metres). Throws InputError where it cannot be
  /// written, or is not of the camera's size.
  void add(const DepthImage& image, const Eigen::Isometry3d& T_world_camera);
  /// Puts the folder in its place. Throws InputError where that cannot be done, or nothing was
  /// added.
  void finish();

 private:
  std::filesystem::path folder_;
  std::unique_ptr<Temporary> temporary_;
  PinholeCamera camera_;
  double rate_;
  std::string images_ = "# timestamp filename\n";
  std::string poses_ = "# timestamp tx ty tz qx qy qz qw\n";
  int count_ = 0;
};

}  // namespace ridgeway
