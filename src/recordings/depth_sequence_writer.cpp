// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cmath>

#include "common/number_text.hpp"
#include "depth_layouts.hpp"
#include "depth_png.hpp"
#include "files/atomic_file.hpp"
#include "recording_folder.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/recordings/depth_sequence.hpp"

namespace ridgeway {

SequenceWriter::SequenceWriter(const std::filesystem::path& folder, const PinholeCamera& camera,
                               double rate)
    : camera_(camera), rate_(rate) {
  camera.validate();
  if (!(rate > 0.0) || !std::isfinite(rate))
    throw InputError("rate", "is no number of images a second", "give one above 0");
  temporary_ = begin_folder(folder, "depth", folder_);
}

SequenceWriter::~SequenceWriter() = default;

void SequenceWriter::add(const DepthImage& image, const Eigen::Isometry3d& T_world_camera) {
  if (image.width != camera_.width || image.height != camera_.height ||
      image.depth.size() !=
          static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw InputError("depth image", "is not of the camera's size",
                     "give " + std::to_string(camera_.width) + " x " +
                         std::to_string(camera_.height) + " depths");
  const std::string name = numbered("depth/", count_, ".png");
  write_depth_png(image, temporary_->path() / name, kTumUnits);
  const std::string time = number_text(count_ / rate_);
  images_ += time + " " + name + "\n";
  poses_ += time + " " + pose_text(T_world_camera) + "\n";
  ++count_;
}

void SequenceWriter::finish() {
  if (count_ == 0) throw InputError(folder_.string(), "has no image yet", "add one first");
  const auto row = [](double a, double b, double c) {
    return number_text(a) + " " + number_text(b) + " " + number_text(c) + "\n";
  };
  const std::string intrinsics =
      row(camera_.fx, 0.0, camera_.cx) + row(0.0, camera_.fy, camera_.cy) + row(0.0, 0.0, 1.0);
  write_text_file(temporary_->path() / kIntrinsicsFile, intrinsics);
  write_text_file(temporary_->path() / kTumImages, images_);
  write_text_file(temporary_->path() / kTumPoses, poses_);
  finish_folder(*temporary_, folder_);
}

}  // namespace ridgeway
