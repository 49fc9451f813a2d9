// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "projective_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "common/number_text.hpp"
#include "depth_surfaces.hpp"
#include "missed_surfaces.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel_look.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kMostBlocks = 1e8;  // looked through for one image

/// Which blocks an image can touch, from the farthest depth in tiles of it.
class View {
 public:
  View(const DepthImage& image, const DepthImage& beyond, const PinholeCamera& camera,
       const Eigen::Isometry3d& T_map_camera, const FusionConfig& config)
      : camera_(camera),
        T_camera_map_(T_map_camera.inverse()),
        side_(kBlockSide * config.voxel_size),
        reach_(0.5 * std::sqrt(3.0) * side_),
        behind_(config.depth_behind),
        across_((image.width + kTile - 1) / kTile),
        down_((image.height + kTile - 1) / kTile),
        tiles_(static_cast<std::size_t>(across_ * down_)) {
    for (int v = 0; v < image.height; ++v)
      for (int u = 0; u < image.width; ++u) {
        auto depth = static_cast<double>(image.at(u, v));
        if (beyond.at(u, v) != 0.0f) depth = config.max_range / camera.ray(u, v).norm();
        if (depth == 0.0) continue;
        double& farthest = tiles_[static_cast<std::size_t>(v / kTile * across_ + u / kTile)];
        farthest = std::max(farthest, depth);
        farthest_ = std::max(farthest_, depth);
      }
    const double end = farthest_ + behind_;
    low_ = high_ = T_map_camera.translation();
    for (const double u : {-0.5, image.width - 0.5})
      for (const double v : {-0.5, image.height - 0.5}) {
        const Point corner = T_map_camera * Point(end * camera.ray(u, v));
        low_ = low_.cwiseMin(corner);
        high_ = high_.cwiseMax(corner);
      }
    // Corners lie farther out than the pixels that are in range.
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(config.max_range + behind_);
    low_ = low_.cwiseMax(T_map_camera.translation() - reach);
    high_ = high_.cwiseMin(T_map_camera.translation() + reach);
  }

  bool sees_nothing() const { return farthest_ == 0.0; }
  /// Blocks in the box around all that is seen.
  double block_count() const { return ((high_ - low_) / side_).array().ceil().prod(); }
  BlockIndex first() const { return block_at(low_); }
  BlockIndex last() const { return block_at(high_); }

  bool sees(const BlockIndex& block) const {
    const Point centre =
        T_camera_map_ * Point(Point(block.x + 0.5, block.y + 0.5, block.z + 0.5) * side_);
    const double z0 = centre.z() - reach_, z1 = centre.z() + reach_;
    if (z1 <= 0.0 || z0 > farthest_ + behind_) return false;
    int u0 = 0, v0 = 0, u1 = across_ - 1, v1 = down_ - 1;
    if (z0 > 0.0) {  // the ball around the block does not reach the camera's plane
      u0 = tile_of(camera_.fx, camera_.cx, centre.x() - reach_, z0, z1);
      u1 = tile_of(camera_.fx, camera_.cx, centre.x() + reach_, z1, z0);
      v0 = tile_of(camera_.fy, camera_.cy, centre.y() - reach_, z0, z1);
      v1 = tile_of(camera_.fy, camera_.cy, centre.y() + reach_, z1, z0);
    }
    for (int v = std::max(v0, 0); v <= std::min(v1, down_ - 1); ++v)
      for (int u = std::max(u0, 0); u <= std::min(u1, across_ - 1); ++u) {
        const double farthest = tiles_[static_cast<std::size_t>(v * across_ + u)];
        if (farthest > 0.0 && z0 <= farthest + behind_) return true;
      }
    return false;
  }

 private:
  static constexpr int kTile = 16;  // pixels along one side
  BlockIndex block_at(const Point& p) const {
    const VoxelIndex v = voxel_at(p, side_);
    return {v.x, v.y, v.z};
  }

  /// The tile in which an edge of the ball appears: nearer for edges that look outwards.
  static int tile_of(double focal, double middle, double edge, double if_negative,
                     double if_positive) {
    const double pixel = focal * edge / (edge < 0.0 ? if_negative : if_positive) + middle;
    return static_cast<int>(std::floor(std::clamp(pixel, -1e6, 1e6) / kTile));
  }

  const PinholeCamera& camera_;
  const Eigen::Isometry3d T_camera_map_;
  const double side_, reach_, behind_;
  const int across_, down_;
  std::vector<double> tiles_;  // the farthest depth of each; 0 where there is none
  double farthest_ = 0.0;
  Point low_, high_;
};

/// The blocks in view, in the order of their indices.
std::vector<BlockIndex> blocks_in(const View& view) {
  const BlockIndex first = view.first(), last = view.last();
  const auto rows = static_cast<std::size_t>(last.y - first.y + 1);
  const auto layers = static_cast<std::size_t>(last.z - first.z + 1);
  std::vector<std::vector<BlockIndex>> found(rows * layers);
  parallel_for_each_index(found.size(), [&](std::size_t i) {
    BlockIndex block{0, first.y + static_cast<int>(i % rows), first.z + static_cast<int>(i / rows)};
    for (block.x = first.x; block.x <= last.x; ++block.x)
      if (view.sees(block)) found[i].push_back(block);
  });
  std::vector<BlockIndex> all;
  for (const auto& row : found) all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// Brings one image to the voxels of a block.
class BlockUpdate {
 public:
  BlockUpdate(const DepthSurfaces& surfaces, const DepthRanges& ranges, const PinholeCamera& camera,
              const Eigen::Isometry3d& T_map_camera, const FusionConfig& config)
      : look_(surfaces, ranges.beyond, camera, config),
        missed_(missed_surfaces(look_, ranges.within, T_map_camera, config)),
        T_camera_map_(T_map_camera.inverse()),
        config_(config) {}

  void run(const BlockIndex& index, TsdfBlock& block) const {
    const double s = config_.voxel_size;
    const Eigen::Vector3f origin = (T_camera_map_ * centre_of(voxel_of(index, 0), s)).cast<float>();
    const Eigen::Matrix3f step = (T_camera_map_.linear() * s).cast<float>();
    int voxel = 0;  // the first of a row
    for (int z = 0; z < kBlockSide; ++z)
      for (int y = 0; y < kBlockSide; ++y, voxel += kBlockSide) {
        const Eigen::Vector3f row =
            origin + static_cast<float>(y) * step.col(1) + static_cast<float>(z) * step.col(2);
        look_.along(row, step.col(0), [&](std::size_t x, const VoxelLook::Measured& m) {
          block.add(voxel + static_cast<int>(x), m.value, m.gain, config_);
        });
      }
    const auto first = std::lower_bound(
        missed_.begin(), missed_.end(), index,
        [](const MissedSurface& m, const BlockIndex& wanted) { return m.block < wanted; });
    for (auto m = first; m != missed_.end() && m->block == index; ++m)
      block.add(m->voxel, m->measured.value, m->measured.gain, config_);
  }

 private:
  const VoxelLook look_;
  const std::vector<MissedSurface> missed_;
  const Eigen::Isometry3d T_camera_map_;
  const FusionConfig& config_;
};

}  // namespace

void integrate_projective(const DepthSurfaces& surfaces, const DepthRanges& ranges,
                          const PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                          const FusionConfig& config, TsdfBlocks& blocks) {
  const View view(surfaces.image(), ranges.beyond, camera, T_map_camera, config);
  if (view.sees_nothing()) return;
  if (view.block_count() > kMostBlocks)
    throw InputError("voxel_size " + number_text(config.voxel_size),
                     "is too small for images that reach so far",
                     "use a larger voxel size or a smaller max_range");
  std::vector<BlockIndex> seen = blocks_in(view);
  std::erase_if(seen, [&](const BlockIndex& block) { return !blocks.takes(block); });
  require_room(blocks, static_cast<double>(seen.size()));
  const BlockUpdate update(surfaces, ranges, camera, T_map_camera, config);
  // Half of what may be in view is not: behind walls, and beside the image. No block is made for
  // it.
  std::vector<std::unique_ptr<TsdfBlock>> made(seen.size());
  parallel_for_each_index(seen.size(), [&](std::size_t i) {
    if (blocks.find(seen[i]) != nullptr) return;
    TsdfBlock block = blocks.fresh();
    update.run(seen[i], block);
    if (!block.is_empty()) made[i] = std::make_unique<TsdfBlock>(std::move(block));
  });
  std::vector<TsdfBlock*> targets(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (made[i] != nullptr || blocks.find(seen[i]) != nullptr)
      targets[i] = &blocks.find_or_add(seen[i]);
  if (config.can_undo) blocks.keep_touched();
  parallel_for_each_index(seen.size(), [&](std::size_t i) {
    if (made[i] != nullptr)
      *targets[i] = std::move(*made[i]);
    else if (targets[i] != nullptr)
      update.run(seen[i], *targets[i]);
  });
}

}  // namespace ridgeway::detail
