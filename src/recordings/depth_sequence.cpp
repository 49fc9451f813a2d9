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
#include "time_association.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSevenScenesImage = ".depth.png", kSevenScenesPose = ".pose.txt";
constexpr double kSevenScenesUnits = 1000.0;  // of an image, a metre

// --- TUM RGB-D

struct StampedImage {
  double time;
  fs::path image;
};
struct StampedPose {
  double time;
  Eigen::Isometry3d T_world_camera;
};

/// In the order of time.
std::vector<StampedImage> read_image_list(const fs::path& file) {
  const char* remedy = "give lines of: timestamp filename";
  std::vector<StampedImage> images;
  for_each_row(file, [&](const TextRow& row) {
    const double time = row.number(0, remedy);
    if (!std::isfinite(time)) row.refuse("has a time that is not finite", remedy);
    if (row.words.size() < 2) row.refuse("names no image", remedy);
    images.push_back({time, file.parent_path() / row.words[1]});
  });
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return images;
}

std::vector<StampedPose> read_trajectory(const fs::path& file) {
  const char* remedy = "give lines of: timestamp tx ty tz qx qy qz qw";
  std::vector<StampedPose> poses;
  for_each_row(file, [&](const TextRow& row) {
    const double time = row.number(0, remedy);
    const auto pose = pose_in_row(row, 1, remedy);
    if (pose && std::isfinite(time)) poses.push_back({time, *pose});
  });
  return poses;
}

template <typename Stamped>
std::vector<double> times_of(const std::vector<Stamped>& all) {
  std::vector<double> times;
  for (const Stamped& one : all) times.push_back(one.time);
  return times;
}

DepthSequence open_tum(const fs::path& folder, const SequenceConfig& config) {
  DepthSequence sequence;
  sequence.layout = "tum";
  sequence.units_per_metre = kTumUnits;
  const std::vector<StampedImage> images = read_image_list(folder / kTumImages);
  const std::vector<StampedPose> poses = read_trajectory(folder / kTumPoses);
  const auto pose_of = associate(times_of(images), times_of(poses), config.longest_gap);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (const auto pose = pose_of[i])
      sequence.frames.push_back({images[i].image, poses[*pose].T_world_camera, images[i].time});
    else
      ++sequence.without_pose;
  }
  return sequence;
}

// --- 7-Scenes and 3DMatch

/// In the order of their names.
std::vector<fs::path> seven_scenes_images(const fs::path& folder) {
  std::vector<fs::path> images;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().filename().string().ends_with(kSevenScenesImage))
      images.push_back(entry->path());
  if (error)
    throw InputError(folder.string(), "cannot be read: " + error.message(),
                     "check its permissions");
  std::sort(images.begin(), images.end());
  return images;
}

/// The pose of a file of 4 x 4 numbers; nothing where tracking was lost.
std::optional<Eigen::Isometry3d> read_pose(const fs::path& file) {
  const char* remedy = "give a 4 x 4 matrix, camera to world, with a rotation in it";
  const std::vector<double> v = read_numbers(file, 16, remedy);
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
  if (!matrix.allFinite()) return std::nullopt;
  const auto pose = pose_of_matrix(matrix);
  if (!pose) throw InputError(file.string(), "is no pose", remedy);
  return pose;
}

DepthSequence open_seven_scenes(const fs::path& folder) {
  DepthSequence sequence;
  sequence.layout = "7-scenes";
  sequence.units_per_metre = kSevenScenesUnits;
  for (const fs::path& image : seven_scenes_images(folder)) {
    std::string name = image.filename().string();
    name.replace(name.size() - kSevenScenesImage.size(), kSevenScenesImage.size(),
                 kSevenScenesPose);
    const auto pose = is_there(folder / name) ? read_pose(folder / name) : std::nullopt;
    if (pose)
      sequence.frames.push_back({image, *pose, {}});
    else
      ++sequence.without_pose;
  }
  return sequence;
}

// --- Open3D, Redwood

/// depth/*.png beside trajectory.log.
bool holds_log(const fs::path& folder) {
  std::error_code error;
  return is_there(folder / kOpen3dPoses) && fs::is_directory(folder / kOpen3dImages, error);
}

/// Five lines a pose: three whole numbers, then a 4 x 4 matrix, camera to world. Nothing for those
/// that are not finite.
std::vector<std::optional<Eigen::Isometry3d>> read_log(const fs::path& file) {
  const char* remedy = "give for each frame a line of three numbers and a 4 x 4 matrix";
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  Eigen::Matrix4d matrix;
  int row_of_pose = 0;
  std::size_t last_line = 0;
  for_each_row(file, [&](const TextRow& row) {
    last_line = row.line;
    if (row.words.size() != (row_of_pose == 0 ? 3 : 4))
      row.refuse("has " + std::to_string(row.words.size()) + " numbers", remedy);
    for (std::size_t i = 0; i < row.words.size(); ++i) {
      const double number = row.number(i, remedy);
      if (row_of_pose > 0) matrix(row_of_pose - 1, static_cast<Eigen::Index>(i)) = number;
    }
    row_of_pose = (row_of_pose + 1) % 5;
    if (row_of_pose != 0) return;
    const auto pose = matrix.allFinite() ? pose_of_matrix(matrix) : std::nullopt;
    if (!pose && matrix.allFinite()) row.refuse("ends a matrix that is no pose", remedy);
    poses.push_back(pose);
  });
  if (row_of_pose != 0)
    throw InputError(file.string(), "ends within a pose, at line " + std::to_string(last_line),
                     remedy);
  return poses;
}

DepthSequence open_log(const fs::path& folder) {
  DepthSequence sequence;
  sequence.layout = "open3d";
  sequence.units_per_metre = kSevenScenesUnits;
  const auto poses = read_log(folder / kOpen3dPoses);
  std::vector<fs::path> images;
  std::error_code error;
  fs::directory_iterator entry(folder / kOpen3dImages, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().extension() == ".png") images.push_back(entry->path());
  if (error)
    throw InputError((folder / kOpen3dImages).string(), "cannot be read: " + error.message(),
                     "check its permissions");
  std::sort(images.begin(), images.end());
  if (images.size() != poses.size())
    throw InputError((folder / kOpen3dPoses).string(),
                     "has " + std::to_string(poses.size()) + " poses for " +
                         std::to_string(images.size()) + " images in " + kOpen3dImages,
                     "give one for each image, in the order of their names");
  for (std::size_t i = 0; i < images.size(); ++i)
    if (poses[i])
      sequence.frames.push_back({images[i], *poses[i], {}});
    else
      ++sequence.without_pose;
  return sequence;
}

/// 3DMatch packs the images into a folder of their own.
fs::path image_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "data", error) ? folder / "data" : folder;
}

// --- both

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

PinholeCamera camera_of(const DepthImage& image, const fs::path& folder,
                        const DepthSequence& sequence, const SequenceConfig& config) {
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
  return sequence.layout != "7-scenes" ? camera(525.0, 525.0, 319.5, 239.5)
                                       : camera(585.0, 585.0, 320.0, 240.0);
}

}  // namespace

bool holds_depth_images(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && (is_there(folder / kTumImages) || holds_log(folder) ||
                                             !seven_scenes_images(image_folder(folder)).empty());
}

DepthSequence open_sequence(const fs::path& folder, const SequenceConfig& config) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string(), "is no folder", "give the folder of a recording");
  const bool is_tum = is_there(folder / kTumImages);
  const bool is_log = !is_tum && holds_log(folder);
  const fs::path inner = is_tum || is_log ? folder : image_folder(folder);
  DepthSequence sequence = is_tum   ? open_tum(folder, config)
                           : is_log ? open_log(folder)
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
