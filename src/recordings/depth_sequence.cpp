// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/recordings/depth_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "common/number_text.hpp"
#include "depth_layouts.hpp"
#include "depth_png.hpp"
#include "pose_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

/// 3DMatch packs the images into a folder of their own.
fs::path image_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "data", error) ? folder / "data" : folder;
}

/// The first image that can be read: recordings have images that cannot.
DepthImage first_readable(const DepthSequence& sequence, const fs::path& folder) {
  std::optional<InputError> first_problem;
  for (const DepthFrame& frame : sequence.frames) {
    try {
      return read_frame(sequence, frame);
    } catch (const InputError& error) {
      if (!first_problem) first_problem = error;
    }
  }
  throw first_problem->within(folder.string() + " has no image that can be read, the first:");
}

/// fx, fy, cx, cy of a camera matrix that has nothing else: no skew, and not its columns as rows.
Eigen::Vector4d read_intrinsics(const fs::path& file) {
  constexpr double kMostSkew = 1e-3;  // pixels
  const char* remedy = "give a 3 x 3 matrix: fx 0 cx, 0 fy cy, 0 0 1";
  const std::vector<double> v = read_numbers(file, 9, remedy);
  for (const std::size_t zero : {1u, 3u, 6u, 7u})
    if (!(std::abs(v[zero]) <= kMostSkew))
      throw InputError(file.string(),
                       "has " + number_text(v[zero]) + " where a camera matrix has 0", remedy);
  if (v[8] != 1.0)
    throw InputError(file.string(), "ends in " + number_text(v[8]) + " in place of 1", remedy);
  return {v[0], v[4], v[2], v[5]};
}

PinholeCamera camera_of(const DepthImage& image, const fs::path& folder, DepthSequence& sequence,
                        const SequenceConfig& config) {
  const auto camera = [&](double fx, double fy, double cx, double cy) {
    return PinholeCamera{image.width, image.height, fx, fy, cx, cy};
  };
  if (config.intrinsics) {
    const Eigen::Vector4d& k = *config.intrinsics;
    return camera(k[0], k[1], k[2], k[3]);
  }
  for (const fs::path& file : {folder / kIntrinsicsFile, folder.parent_path() / kIntrinsicsFile}) {
    if (!is_there(file)) continue;
    const Eigen::Vector4d k = read_intrinsics(file);
    const PinholeCamera read = camera(k[0], k[1], k[2], k[3]);
    try {
      read.validate();
    } catch (const InputError& error) {
      throw error.within(file.string());
    }
    return read;
  }
  if (image.width != 640 || image.height != 480)
    throw InputError(folder.string(),
                     "has no " + std::string(kIntrinsicsFile) + ", and its images are " +
                         std::to_string(image.width) + " x " + std::to_string(image.height),
                     "give the intrinsics: the layout's are for 640 x 480");
  sequence.is_camera_assumed = true;
  return sequence.layout != "7-scenes" ? camera(525.0, 525.0, 319.5, 239.5)
                                       : camera(585.0, 585.0, 320.0, 240.0);
}

}  // namespace

bool holds_depth_images(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && (is_there(folder / kTumImages) || holds_log(folder) ||
                                             holds_seven_scenes(image_folder(folder)));
}

DepthSequence open_sequence(const fs::path& folder, const SequenceConfig& config) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string(), "is no folder", "give the folder of a recording");
  const bool is_tum = is_there(folder / kTumImages);
  const bool is_log = !is_tum && holds_log(folder);
  const fs::path inner = is_tum || is_log ? folder : image_folder(folder);
  DepthSequence sequence = is_tum   ? open_tum(folder, config)
                           : is_log ? open_log(folder, config)
                                    : open_seven_scenes(inner);
  if (sequence.frames.empty())
    throw InputError(folder.string(),
                     sequence.without_pose > 0 ? "has no image with a pose" : "holds no recording",
                     "give depth.txt, groundtruth.txt and the images (TUM), frame-*.depth.png and "
                     "frame-*.pose.txt (7-Scenes), or depth/*.png and trajectory.log (Open3D)");
  sequence.camera = camera_of(first_readable(sequence, folder), inner, sequence, config);
  sequence.camera.validate();
  return sequence;
}

DepthImage read_frame(const DepthSequence& sequence, const DepthFrame& frame) {
  return read_depth_png(frame.image, sequence.units_per_metre);
}

}  // namespace ridgeway
