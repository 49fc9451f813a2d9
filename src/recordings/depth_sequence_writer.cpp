// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <sstream>
#include <system_error>

#include "common/number_text.hpp"
#include "depth_layouts.hpp"
#include "depth_png.hpp"
#include "files/atomic_file.hpp"
#include "files/file_error.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProblem = "cannot be written";
constexpr double kFrameSeconds = 0.1;  // between simulated images

}  // namespace

SequenceWriter::SequenceWriter(const fs::path& folder, const PinholeCamera& camera)
    : camera_(camera) {
  camera.validate();
  std::error_code error;
  folder_ = fs::weakly_canonical(fs::absolute(folder, error), error);  // "run/.", and links
  if (!folder_.has_filename()) folder_ = folder_.parent_path();        // "run/"
  if (error) detail::fail_file(folder, kProblem, error.value());
  if (!folder_.has_filename())
    throw InputError("'" + folder.string() + "'", "is no folder that can be made",
                     "give a new folder");
  if (fs::exists(folder_, error) &&
      !(fs::is_directory(folder_, error) && fs::is_empty(folder_, error)))
    throw InputError(folder_.string(), "exists and is not empty", "give a new folder");
  fs::create_directories(folder_.parent_path(), error);
  if (error) detail::fail_file(folder_, kProblem, error.value());
  temporary_ = std::make_unique<Temporary>(folder_, Temporary::Kind::kFolder);
  if (temporary_->error() != 0) detail::fail_file(folder_, kProblem, temporary_->error());
  fs::create_directory(temporary_->path() / "depth", error);
  if (error) detail::fail_file(folder_, kProblem, error.value());
}

SequenceWriter::~SequenceWriter() = default;

void SequenceWriter::add(const DepthImage& image, const Eigen::Isometry3d& T_world_camera) {
  std::ostringstream name;
  name << "depth/";
  name.width(6);
  name.fill('0');
  name << count_ << ".png";
  write_depth_png(image, temporary_->path() / name.str(), kTumUnits);
  const std::string time = number_text(count_ * kFrameSeconds);
  const Eigen::Quaterniond q(T_world_camera.linear());
  const Point& t = T_world_camera.translation();
  images_ += time + " " + name.str() + "\n";
  poses_ += time;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    poses_.append(" ").append(number_text(value));
  poses_ += "\n";
  ++count_;
}

void SequenceWriter::finish() {
  const auto row = [](double a, double b, double c) {
    return number_text(a) + " " + number_text(b) + " " + number_text(c) + "\n";
  };
  const std::string intrinsics =
      row(camera_.fx, 0.0, camera_.cx) + row(0.0, camera_.fy, camera_.cy) + row(0.0, 0.0, 1.0);
  write_text_file(temporary_->path() / kIntrinsicsFile, intrinsics);
  write_text_file(temporary_->path() / kTumImages, images_);
  write_text_file(temporary_->path() / kTumPoses, poses_);
  if (const int failed = temporary_->move_to(folder_); failed != 0)
    detail::fail_file(folder_, kProblem, failed);
}

}  // namespace ridgeway
