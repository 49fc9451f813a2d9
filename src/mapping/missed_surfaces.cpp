// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "missed_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

/// Where the depth of an image jumps from one pixel to the next. Far from jumps, whatever pixel
/// sees a voxel's centre sees the same surface as one that sees another place in the voxel.
class Jumps {
 public:
  Jumps(const DepthImage& image, float least)
      : width_(image.width), height_(image.height), before_(place(0, height_ + 1)) {
    std::vector<std::uint8_t> jumps(static_cast<std::size_t>(width_));
    for (int v = 0; v < height_; ++v) {
      const float* row = &image.depth[static_cast<std::size_t>(v) * jumps.size()];
      const float* below = v + 1 < height_ ? row + width_ : row;
      for (std::size_t u = 0; u < jumps.size(); ++u) jumps[u] = std::abs(row[u] - below[u]) > least;
      for (std::size_t u = 0; u + 1 < jumps.size(); ++u)
        jumps[u] |= static_cast<std::uint8_t>(std::abs(row[u] - row[u + 1]) > least);
      std::uint32_t in_row = 0;
      for (int u = 0; u < width_; ++u) {
        in_row += jumps[static_cast<std::size_t>(u)];
        before_[place(u + 1, v + 1)] = before_[place(u + 1, v)] + in_row;
      }
    }
  }

  /// Whether there is one within so many pixels of some in a row, from one up to before another.
  bool any_around(int first_u, int end_u, int v, int reach) const {
    const int u0 = std::max(first_u - reach, 0), u1 = std::min(end_u + reach, width_);
    const int v0 = std::max(v - reach, 0), v1 = std::min(v + reach + 1, height_);
    return before_[place(u1, v1)] + before_[place(u0, v0)] !=
           before_[place(u0, v1)] + before_[place(u1, v0)];
  }

 private:
  std::size_t place(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_ + 1) +
           static_cast<std::size_t>(u);
  }

  const int width_, height_;
  std::vector<std::uint32_t> before_;  // jumps in all rows and columns before a corner of pixels
};

/// Voxels around the camera, by their offset from its own: small numbers, wherever the map is.
class VoxelsAround {
 public:
  VoxelsAround(const Eigen::Isometry3d& T_map_camera, double voxel_size)
      : voxel_size_(static_cast<float>(voxel_size)),
        per_voxel_(1.0f / voxel_size_),
        own_(voxel_at(T_map_camera.translation(), voxel_size)),
        turn_(T_map_camera.linear().cast<float>()),
        off_((T_map_camera.translation() - centre_of(own_, voxel_size)).cast<float>()) {}

  VoxelIndex voxel_of(const Eigen::Vector3f& seen) const {
    const Eigen::Vector3f offset = (turn_ * seen + off_) * per_voxel_;
    const auto rounded = [](float x) { return static_cast<int>(x + std::copysign(0.5f, x)); };
    return own_ + VoxelIndex{rounded(offset.x()), rounded(offset.y()), rounded(offset.z())};
  }
  /// In the camera's frame.
  Eigen::Vector3f centre_of_voxel(const VoxelIndex& voxel) const {
    const VoxelIndex offset = voxel - own_;
    const Eigen::Vector3f from_own(static_cast<float>(offset.x), static_cast<float>(offset.y),
                                   static_cast<float>(offset.z));
    return turn_.transpose() * (from_own * voxel_size_ - off_);
  }

 private:
  const float voxel_size_, per_voxel_;
  const VoxelIndex own_;
  const Eigen::Matrix3f turn_;
  const Eigen::Vector3f off_;  // of the camera from the centre of its voxel
};

/// Looks at the pixels of an image near jumps for voxels whose centres look past what they see.
class Search {
 public:
  Search(const VoxelLook& look, const DepthImage& raw, const Eigen::Isometry3d& T_map_camera,
         const FusionConfig& config)
      : look_(look),
        image_(look.image()),
        raw_(raw),
        voxel_size_(static_cast<float>(config.voxel_size)),
        voxels_(T_map_camera, config.voxel_size),
        jumps_(image_, 0.5f * voxel_size_) {
    reach_ = std::sqrt(3.0f) * 0.5f * voxel_size_ / side_of_a_pixel();
  }

  /// Some voxels maybe several times.
  std::vector<MissedSurface> in_row(int v) const {
    constexpr int kRun = 16;
    std::vector<MissedSurface> missed;
    for (int first = 0; first < image_.width; first += kRun) {
      const int end = std::min(first + kRun, image_.width);
      float nearest = std::numeric_limits<float>::infinity();
      for (int u = first; u < end; ++u)
        if (image_.at(u, v) > 0.0f) nearest = std::min(nearest, image_.at(u, v));
      if (std::isfinite(nearest) && jumps_.any_around(first, end, v, pixels_at(nearest)))
        add_run(first, end, v, missed);
    }
    return missed;
  }

 private:
  /// At a depth of 1; the shorter side.
  float side_of_a_pixel() const {
    const bool is_wide = image_.width > 1, is_high = image_.height > 1;
    const Eigen::Vector3f pixel =
        look_.ray_of({is_wide ? 1 : 0, is_high ? 1 : 0}) - look_.ray_of({0, 0});
    if (is_wide && is_high) return pixel.head<2>().minCoeff();
    return is_wide ? pixel.x() : is_high ? pixel.y() : 1.0f;
  }
  /// How far a voxel reaches, and no farther than an image.
  int pixels_at(float depth) const { return static_cast<int>(std::min(reach_ / depth, 1e4f)) + 1; }

  void add_run(int first, int end, int v, std::vector<MissedSurface>& missed) const {
    constexpr int kNone = std::numeric_limits<int>::min();
    constexpr int kMany = 4;  // a voxel that reaches so far is seen by every other pixel
    VoxelIndex last{kNone, kNone, kNone};  // pixels beside each other are mostly of one voxel
    bool is_missed = false;
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    for (int u = first; u < end; ++u) {
      const float depth = image_.at(u, v);
      if (depth == 0.0f || std::abs(depth - raw_.at(u, v)) > 0.25f * voxel_size_) continue;
      const int reach = pixels_at(depth);
      if ((reach > kMany && (u + v) % 2 != 0) || !jumps_.any_around(u, u + 1, v, reach)) continue;
      const VoxelIndex voxel = voxels_.voxel_of(depth * look_.ray_of({u, v}));
      const bool is_same = voxel == last;
      if (!is_same) {
        last = voxel;
        centre = voxels_.centre_of_voxel(voxel);
        const VoxelLook::Measured own = look_.at(centre);
        is_missed = own.gain == 0.0f || own.value >= voxel_size_;
      }
      if (!is_missed) continue;
      const VoxelLook::Measured by = look_.by({u, v}, centre, 0.5f * voxel_size_);
      if (!is_same)
        missed.push_back({block_of(voxel), local_of(voxel), by});
      else if (std::abs(by.value) < std::abs(missed.back().measured.value))
        missed.back().measured = by;
    }
  }

  const VoxelLook& look_;
  const DepthImage &image_, &raw_;
  const float voxel_size_;
  const VoxelsAround voxels_;
  const Jumps jumps_;
  float reach_ = 0.0f;  // of a voxel at a depth of 1, pixels
};

}  // namespace

std::vector<MissedSurface> missed_surfaces(const VoxelLook& look, const DepthImage& raw,
                                           const Eigen::Isometry3d& T_map_camera,
                                           const FusionConfig& config) {
  const Search search(look, raw, T_map_camera, config);
  std::vector<std::vector<MissedSurface>> of_row(static_cast<std::size_t>(look.image().height));
  parallel_for_each_index(
      of_row.size(), [&](std::size_t row) { of_row[row] = search.in_row(static_cast<int>(row)); },
      8);
  std::vector<MissedSurface> missed;
  for (const std::vector<MissedSurface>& some : of_row)
    missed.insert(missed.end(), some.begin(), some.end());
  const auto key = [](const MissedSurface& m) { return std::pair(m.block, m.voxel); };
  std::stable_sort(missed.begin(), missed.end(), [&](const auto& a, const auto& b) {
    return key(a) != key(b) ? key(a) < key(b)
                            : std::abs(a.measured.value) < std::abs(b.measured.value);
  });
  missed.erase(std::unique(missed.begin(), missed.end(),
                           [&](const auto& a, const auto& b) { return key(a) == key(b); }),
               missed.end());
  return missed;
}

}  // namespace ridgeway::detail
