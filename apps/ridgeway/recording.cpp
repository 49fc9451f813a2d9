// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "recording.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <system_error>

#include "common/number_text.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"
#include "ridgeway/recordings/scan_sequence.hpp"

namespace ridgeway::cli {

RecordingKind kind_of_recording(const std::string& folder) {
  if (holds_depth_images(folder)) return RecordingKind::kImages;
  if (holds_scans(folder)) return RecordingKind::kScans;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError(folder, "is no folder" + (error ? ": " + error.message() : std::string()),
                     "give the folder of a recording");
  // Lists of poses without names and times, as some textbooks have them.
  if (std::filesystem::exists(std::filesystem::path(folder) / "pose.txt", error))
    throw InputError(folder,
                     "has poses in pose.txt that name no images, and neither a unit nor a camera",
                     "write them as 4 x 4 matrices to trajectory.log, one for each of depth/*.png, "
                     "which are in millimetres (Open3D)");
  throw InputError(
      folder, "holds no recording",
      "give a folder with depth.txt (TUM RGB-D), frame-*.depth.png (7-Scenes, "
      "3DMatch), depth/ and trajectory.log (Open3D), or scans and their poses in poses.txt");
}

void PointCounts::add(const PointCloud& cloud, const FusionConfig& config) {
  not_finite += cloud.skipped;
  for (const Point& point : cloud.points) {
    const double range = point.norm();
    ++(config.takes(range) ? fused : out_of_range);
    beyond += config.is_beyond(range);
  }
}

void note_points_without_surface(const Globals& globals, const PointCounts& points) {
  const std::size_t useless = points.out_of_range - points.beyond;
  if (useless + points.not_finite > 0)
    note(globals,
         "passed over: " + count_text(useless) +
             " points nearer than --min-range or more than 20 times --max-range away, and " +
             count_text(points.not_finite) + " that are not finite");
  if (points.beyond > 0)
    note(globals, count_text(points.beyond) +
                      " points beyond --max-range show no surface: they free the way up to there");
}

void note_without_pose(const Globals& globals, std::size_t count, const std::string& layout) {
  if (count == 0) return;
  const SequenceConfig config;
  std::string why;
  if (layout == "tum")
    why = ": a pose within " + number_text(config.longest_gap) + " s is needed, or two around it " +
          number_text(config.longest_step) + " s apart at most";
  note(globals, count_text(count) + (count == 1 ? " frame has" : " frames have") + " no pose and " +
                    (count == 1 ? "was" : "were") + " passed over" + why);
}

void warn_of_unreadable(const Globals& globals, std::size_t count, const std::string& first) {
  if (count == 0) return;
  warn(globals, count_text(count) + (count == 1 ? " image was" : " images were") +
                    " passed over, " + (count == 1 ? "" : "the first: ") + first);
}

std::string told_of_upward_axis(const DepthSequence& sequence) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const DepthFrame& frame : sequence.frames) up -= frame.T_world_camera.linear().col(1);
  constexpr double kHalf = 0.5;  // the cosine of 60 degrees; of nearly nothing if they look around
  if (up.norm() < kHalf * static_cast<double>(sequence.frames.size())) return {};
  up.normalize();
  if (up.z() > kHalf) return {};
  std::ostringstream text;
  text << std::setprecision(2) << up.x() << ',' << up.y() << ',' << up.z();
  return "the cameras are upright along " + text.str() +
         " of the world of their poses, not along z, which maps and pictures take for up: turn the "
         "poses, or what `fuse` makes of them with `ridgeway build --transform`";
}

void note_assumed_camera(const Globals& globals, const DepthSequence& sequence) {
  if (!sequence.is_camera_assumed) return;
  const PinholeCamera& camera = sequence.camera;
  std::ostringstream text;
  text << camera.fx << ',' << camera.fy << ',' << camera.cx << ',' << camera.cy;
  note(globals, "the recording names no intrinsics: " + text.str() +
                    " are taken, as usual for its layout (--intrinsics of fuse, or "
                    "camera-intrinsics.txt in its folder, for others)");
}

void require_recordable(const DepthSensor& sensor) {
  if (sensor.max_range <= SequenceWriter::kFarthest) return;
  const std::string most = number_text(SequenceWriter::kFarthest);
  throw InputError("--max-range " + number_text(sensor.max_range),
                   "is farther than a recording's images hold, which is " + most + " m",
                   "give " + most + " or less");
}

void require_outside(const std::filesystem::path& output, const std::filesystem::path& folder) {
  std::error_code error;
  const auto whole = std::filesystem::weakly_canonical(folder, error);
  const auto file = std::filesystem::weakly_canonical(output, error);
  if (std::filesystem::exists(file, error) && extension_of(file) != ".ridge" &&
      std::mismatch(whole.begin(), whole.end(), file.begin(), file.end()).first == whole.end())
    throw InputError(output.string(), "is part of the recording", "give another file to write to");
}

}  // namespace ridgeway::cli
