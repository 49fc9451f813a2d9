// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "plain_fusion.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeway::detail {
namespace {

TsdfMap map_of(double voxel_size, double truncation, std::vector<BlockIndex> blocks) {
  TsdfMap map;
  map.voxel_size = voxel_size;
  map.truncation = truncation;
  map.layout = BlockLayout(std::move(blocks));
  map.distance = VoxelField<float>(map.layout);
  map.weight = VoxelField<float>(map.layout);
  return map;
}

}  // namespace

PlainVoxels::PlainVoxels(double voxel_size, double truncation, const Box& box)
    : voxel_size_(voxel_size), truncation_(truncation) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(truncation);
  low_ = voxel_at(box.min - margin, voxel_size);
  size_ = voxel_at(box.max + margin, voxel_size) - low_ + VoxelIndex{1, 1, 1};
  voxels_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                 static_cast<std::size_t>(size_.z));
}

std::size_t PlainVoxels::place(const VoxelIndex& v) const {
  return (static_cast<std::size_t>(v.z) * static_cast<std::size_t>(size_.y) +
          static_cast<std::size_t>(v.y)) *
             static_cast<std::size_t>(size_.x) +
         static_cast<std::size_t>(v.x);
}

void PlainVoxels::integrate(const DepthImage& image, const PinholeCamera& camera,
                            const Eigen::Isometry3d& T_world_camera) {
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  VoxelIndex v;
  for (v.z = 0; v.z < size_.z; ++v.z)
    for (v.y = 0; v.y < size_.y; ++v.y)
      for (v.x = 0; v.x < size_.x; ++v.x) {
        const Point p = T_camera_world * centre_of(low_ + v, voxel_size_);
        if (p.z() <= 0.0) continue;
        const int u = static_cast<int>(std::floor(camera.fx * p.x() / p.z() + camera.cx + 0.5));
        const int w = static_cast<int>(std::floor(camera.fy * p.y() / p.z() + camera.cy + 0.5));
        if (u < 0 || w < 0 || u >= image.width || w >= image.height) continue;
        const auto depth = static_cast<double>(image.at(u, w));
        if (depth == 0.0) continue;
        const double value = (depth - p.z()) * camera.ray(u, w).norm();
        if (value < -truncation_) continue;
        voxels_[place(v)].add(std::min(value, truncation_), 1.0 / (p.z() * p.z()));
      }
}

TsdfMap PlainVoxels::map() const {
  std::vector<BlockIndex> blocks;
  const BlockIndex first = block_of(low_), last = block_of(low_ + size_ - VoxelIndex{1, 1, 1});
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) blocks.push_back({x, y, z});
  TsdfMap map = map_of(voxel_size_, truncation_, std::move(blocks));
  VoxelIndex v;
  for (v.z = 0; v.z < size_.z; ++v.z)
    for (v.y = 0; v.y < size_.y; ++v.y)
      for (v.x = 0; v.x < size_.x; ++v.x) {
        const VoxelId id = map.layout.find(low_ + v);
        map.distance[id] = voxels_[place(v)].distance;
        map.weight[id] = voxels_[place(v)].weight;
      }
  return map;
}

void PlainRays::integrate(const DepthImage& image, const PinholeCamera& camera,
                          const Eigen::Isometry3d& T_world_camera) {
  const Point sensor = T_world_camera.translation();
  for (int w = 0; w < image.height; ++w)
    for (int u = 0; u < image.width; ++u) {
      const auto depth = static_cast<double>(image.at(u, w));
      if (depth == 0.0) continue;
      const Eigen::Vector3d to_end = T_world_camera.linear() * (depth * camera.ray(u, w));
      const double range = to_end.norm();
      const Eigen::Vector3d along = to_end / range;
      // A step of half a voxel misses next to none; each voxel counts once a ray.
      VoxelIndex last = voxel_at(sensor - along * (2.0 * voxel_size_), voxel_size_);
      for (double t = 0.0; t <= range + truncation_; t += 0.5 * voxel_size_) {
        const VoxelIndex voxel = voxel_at(sensor + t * along, voxel_size_);
        if (voxel == last) continue;
        last = voxel;
        auto& block = blocks_[block_of(voxel)];
        if (block.empty()) block.resize(kBlockVoxels);
        const double value = range - (centre_of(voxel, voxel_size_) - sensor).dot(along);
        if (value < -truncation_) continue;
        block[static_cast<std::size_t>(local_of(voxel))].add(std::min(value, truncation_),
                                                             1.0 / (depth * depth));
      }
    }
}

TsdfMap PlainRays::map() const {
  std::vector<BlockIndex> blocks;
  for (const auto& [index, voxels] : blocks_) blocks.push_back(index);
  TsdfMap map = map_of(voxel_size_, truncation_, std::move(blocks));
  for (const auto& [index, voxels] : blocks_) {
    const std::uint32_t slot = map.layout.find_block(index);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      map.distance.block(slot)[i] = voxels[i].distance;
      map.weight.block(slot)[i] = voxels[i].weight;
    }
  }
  return map;
}

}  // namespace ridgeway::detail
