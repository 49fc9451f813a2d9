// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "depth_layouts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <system_error>
#include <vector>

#include "common/number_text.hpp"
#include "files/natural_order.hpp"
#include "pose_text.hpp"
#include "ridgeway/common/error.hpp"
#include "time_association.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSevenScenesImage = ".depth.png", kSevenScenesPose = ".pose.txt";
constexpr double kSevenScenesUnits = 1000.0;  // of an image, a metre

/// The files of a folder whose names have that ending, in the order of the numbers in them: 10
/// comes after 9.
std::vector<fs::path> images_in(const fs::path& folder, std::string_view ending) {
  std::vector<fs::path> images;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().filename().string().ends_with(ending)) images.push_back(entry->path());
  if (error)
    throw InputError(folder.string(), "cannot be read: " + error.message(),
                     "check its permissions");
  std::sort(images.begin(), images.end(), [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().string(), b.filename().string());
  });
  return images;
}

Lines lines_of(const SequenceConfig& config) {
  return config.is_growing ? Lines::kWhole : Lines::kAll;
}

// --- TUM RGB-D

struct StampedImage {
  double time;
  fs::path image;
};
struct StampedPose {
  double time;
  std::optional<Eigen::Isometry3d> T_world_camera;  ///< none: tracking was lost
};

/// The time that begins a row, seconds.
double time_in_row(const TextRow& row, const char* remedy) {
  constexpr double kLatest = 1e11;  // the year 5138; milliseconds since 1970 are more
  const double time = row.number(0, remedy);
  if (time > kLatest)
    row.refuse("has a time that is no second of our age",
               "give seconds: divide by 1e3, 1e6 or 1e9");
  return time;
}

/// In the order of time.
std::vector<StampedImage> read_image_list(const fs::path& file, Lines lines) {
  const char* remedy = "give lines of: timestamp filename";
  std::vector<StampedImage> images;
  for_each_row(
      file,
      [&](const TextRow& row) {
        const double time = time_in_row(row, remedy);
        if (!std::isfinite(time)) row.refuse("has a time that is not finite", remedy);
        if (row.words.size() < 2) row.refuse("names no image", remedy);
        images.push_back({time, file.parent_path() / row.words[1]});
      },
      lines);
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return images;
}

/// In the order of time.
std::vector<StampedPose> read_trajectory(const fs::path& file, Lines lines) {
  const char* remedy = "give lines of: timestamp tx ty tz qx qy qz qw";
  std::vector<StampedPose> poses;
  for_each_row(
      file,
      [&](const TextRow& row) {
        const double time = time_in_row(row, remedy);
        const auto pose = pose_in_row(row, 1, remedy);
        if (std::isfinite(time)) poses.push_back({time, pose});
      },
      lines);
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  const auto twice =
      std::adjacent_find(poses.begin(), poses.end(), [](const auto& a, const auto& b) {
        return a.time == b.time && a.T_world_camera && b.T_world_camera &&
               !a.T_world_camera->isApprox(*b.T_world_camera, 1e-6);
      });
  if (twice != poses.end())
    throw InputError(file.string(), "has two poses at the time " + number_text(twice->time),
                     "give times with all their decimals");
  return poses;
}

template <typename Stamped>
std::vector<double> times_of(const std::vector<Stamped>& all) {
  std::vector<double> times;
  times.reserve(all.size());
  for (const Stamped& one : all) times.push_back(one.time);
  return times;
}

/// Of times in seconds since 1970: 0.2 s are no more than 0.2.
constexpr double kTimeRounding = 1e-6;

/// The pose at a time that two poses lie around which are no farther apart than a step: on the line
/// between them, turning evenly. Poses in the order of time.
std::optional<Eigen::Isometry3d> pose_between(const std::vector<StampedPose>& poses, double time,
                                              double longest_step) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), time,
                       [](const StampedPose& pose, double asked) { return pose.time < asked; });
  if (after == poses.end()) return std::nullopt;
  if (after->time == time) return after->T_world_camera;
  if (after == poses.begin()) return std::nullopt;
  const StampedPose& before = after[-1];
  const double step = after->time - before.time;
  if (!before.T_world_camera || !after->T_world_camera || step > longest_step + kTimeRounding)
    return std::nullopt;
  const double share = (time - before.time) / step;
  const Eigen::Isometry3d &from = *before.T_world_camera, &to = *after->T_world_camera;
  Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
  between.linear() = Eigen::Quaterniond(from.linear())
                         .slerp(share, Eigen::Quaterniond(to.linear()))
                         .toRotationMatrix();
  between.translation() = from.translation() + share * (to.translation() - from.translation());
  return between;
}

/// The pose of each image, both in the order of time: that between two poses, else the nearest one
/// that no other image has.
std::vector<std::optional<Eigen::Isometry3d>> poses_of(const std::vector<StampedImage>& images,
                                                       const std::vector<StampedPose>& poses,
                                                       const SequenceConfig& config) {
  const std::vector<double> times = times_of(images);
  const bool between = config.longest_step > 0.0;
  std::vector<std::optional<Eigen::Isometry3d>> found(images.size());
  std::vector<std::size_t> others;
  std::vector<double> times_of_others;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (between) found[i] = pose_between(poses, times[i], config.longest_step);
    if (found[i]) continue;
    others.push_back(i);
    times_of_others.push_back(times[i]);
  }
  std::vector<StampedPose> left;
  for (const StampedPose& pose : poses)
    if (pose.T_world_camera &&
        !(between && std::binary_search(times.begin(), times.end(), pose.time)))
      left.push_back(pose);
  const auto nearest =
      associate(times_of_others, times_of(left), config.longest_gap + kTimeRounding);
  for (std::size_t i = 0; i < others.size(); ++i)
    if (nearest[i]) found[others[i]] = left[*nearest[i]].T_world_camera;
  return found;
}

/// Whether one list of times goes on for many times as long as the other: in another unit.
bool are_of_two_clocks(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kUnits = 50.0;
  const double one = a.back() - a.front(), other = b.back() - b.front();
  return std::max(one, other) > kUnits * std::min(one, other) && a.size() > 2 && b.size() > 2;
}

/// Where hardly an image has a pose: one may have, as both clocks may begin at zero.
[[noreturn]] void refuse_clocks(const std::vector<double>& images, const std::vector<double>& poses,
                                std::size_t found, double longest_gap, const fs::path& folder) {
  const auto span_of = [](const std::vector<double>& times) {
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    return " from " + number_text(*first) + " to " + number_text(*last);
  };
  throw InputError(folder.string(),
                   (found == 0 ? "has no pose" : "has one pose alone") +
                       (" within " + number_text(longest_gap)) + " s of an image: images are" +
                       span_of(images) + ", poses" + span_of(poses),
                   "give the times of both by one clock");
}

// --- 7-Scenes and 3DMatch

/// The pose of a file of 4 x 4 numbers; nothing where tracking was lost.
std::optional<Eigen::Isometry3d> read_pose(const fs::path& file) {
  const char* remedy = "give a 4 x 4 matrix, camera to world, with a rotation in it";
  const std::vector<double> v = read_numbers(file, 16, remedy);
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
  if (!matrix.allFinite()) return std::nullopt;
  auto pose = pose_of_matrix(matrix);
  if (!pose) throw InputError(file.string(), "is no pose", remedy);
  return pose;
}

// --- Open3D, Redwood

/// The first number of a pose is its frame's, or the same for all.
void require_in_order(const std::vector<double>& numbers, const fs::path& file) {
  const auto stop = std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>());
  const bool are_same =
      std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) == numbers.end();
  if (stop == numbers.end() || are_same) return;
  throw InputError(file.string(),
                   "has pose " + number_text(stop[1]) + " after pose " + number_text(stop[0]),
                   "give one pose for each image, in ascending order");
}

/// Five lines a pose: three whole numbers, then a 4 x 4 matrix, camera to world. Nothing for those
/// that are not finite.
std::vector<std::optional<Eigen::Isometry3d>> read_log(const fs::path& file, Lines lines) {
  const char* remedy = "give for each frame a line of three numbers and a 4 x 4 matrix";
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  std::vector<double> numbers;  // that poses have
  Eigen::Matrix4d matrix;
  int row_of_pose = 0;
  std::size_t last_line = 0;
  for_each_row(
      file,
      [&](const TextRow& row) {
        last_line = row.line;
        if (row.words.size() != (row_of_pose == 0 ? 3 : 4))
          row.refuse("has " + std::to_string(row.words.size()) + " numbers", remedy);
        for (std::size_t i = 0; i < row.words.size(); ++i) {
          const double number = row.number(i, remedy);
          if (row_of_pose == 0 && i == 0) numbers.push_back(number);
          if (row_of_pose > 0) matrix(row_of_pose - 1, static_cast<Eigen::Index>(i)) = number;
        }
        row_of_pose = (row_of_pose + 1) % 5;
        if (row_of_pose != 0) return;
        const auto pose = matrix.allFinite() ? pose_of_matrix(matrix) : std::nullopt;
        if (!pose && matrix.allFinite()) row.refuse("ends a matrix that is no pose", remedy);
        poses.push_back(pose);
      },
      lines);
  if (row_of_pose != 0 && lines == Lines::kAll)
    throw InputError(file.string(), "ends within a pose, at line " + std::to_string(last_line),
                     remedy);
  require_in_order(numbers, file);
  return poses;
}

}  // namespace

DepthSequence open_tum(const fs::path& folder, const SequenceConfig& config) {
  DepthSequence sequence;
  sequence.layout = "tum";
  sequence.units_per_metre = kTumUnits;
  const std::vector<StampedImage> images = read_image_list(folder / kTumImages, lines_of(config));
  const std::vector<StampedPose> poses = read_trajectory(folder / kTumPoses, lines_of(config));
  const auto pose_of = poses_of(images, poses, config);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (pose_of[i])
      sequence.frames.push_back({images[i].image, *pose_of[i], images[i].time});
    else
      ++sequence.without_pose;
  }
  sequence.poses_until =
      poses.empty() ? -std::numeric_limits<double>::infinity() : poses.back().time;
  std::vector<double> known;
  for (const StampedPose& pose : poses)
    if (pose.T_world_camera) known.push_back(pose.time);
  const std::size_t found = sequence.frames.size();
  if (images.empty() || known.empty()) return sequence;
  if (found == 0 ||
      (found == 1 && !config.is_growing && are_of_two_clocks(times_of(images), known)))
    refuse_clocks(times_of(images), known, found, config.longest_gap, folder);
  return sequence;
}

bool holds_seven_scenes(const fs::path& folder) {
  return !images_in(folder, kSevenScenesImage).empty();
}

DepthSequence open_seven_scenes(const fs::path& folder) {
  DepthSequence sequence;
  sequence.layout = "7-scenes";
  sequence.units_per_metre = kSevenScenesUnits;
  for (const fs::path& image : images_in(folder, kSevenScenesImage)) {
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

bool holds_log(const fs::path& folder) {
  std::error_code error;
  return is_there(folder / kOpen3dPoses) && fs::is_directory(folder / kOpen3dImages, error);
}

/// How many images there are before the first whose number is not one more than that of the one
/// before: what is missing there may still come. All where numbers do not count images.
std::size_t images_before_gap(const std::vector<fs::path>& images) {
  const auto number_of = [&](std::size_t i) { return last_number(images[i].stem().string()); };
  std::size_t before = images.size();
  for (std::size_t i = 1; i < images.size(); ++i) {
    const auto number = number_of(i), last = number_of(i - 1);
    if (!number || !last) return images.size();
    if (before == images.size() && *number != *last + 1) before = i;
  }
  if (images.empty() || before == images.size()) return before;
  // Steps of two or more, or times, are no count.
  const double counted = static_cast<double>(*number_of(images.size() - 1) - *number_of(0));
  return counted <= 1.5 * static_cast<double>(images.size()) + 5.0 ? before : images.size();
}

DepthSequence open_log(const fs::path& folder, const SequenceConfig& config) {
  DepthSequence sequence;
  sequence.layout = "open3d";
  sequence.units_per_metre = kSevenScenesUnits;
  const auto poses = read_log(folder / kOpen3dPoses, lines_of(config));
  const std::vector<fs::path> images = images_in(folder / kOpen3dImages, ".png");
  if (images.size() != poses.size() && !config.is_growing)
    throw InputError((folder / kOpen3dPoses).string(),
                     "has " + std::to_string(poses.size()) + " poses for " +
                         std::to_string(images.size()) + " images in " + kOpen3dImages,
                     "give one for each image, in the order of the numbers in their names");
  const std::size_t whole = config.is_growing ? images_before_gap(images) : images.size();
  const std::size_t pairs = std::min(whole, poses.size());
  sequence.without_pose = images.size() - pairs;
  for (std::size_t i = 0; i < pairs; ++i)
    if (poses[i])
      sequence.frames.push_back({images[i], *poses[i], {}});
    else
      ++sequence.without_pose;
  return sequence;
}

}  // namespace ridgeway
