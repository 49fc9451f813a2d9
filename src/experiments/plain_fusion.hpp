// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <unordered_map>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/sensing/depth_camera.hpp"

namespace ridgeway::detail {

/// A truncated distance and its weight.
struct PlainVoxel {
  float distance = 0.0f, weight = 0.0f;
  void add(double value, double gain) {
    const double sum = static_cast<double>(weight) + gain;
    distance = static_cast<float>(
        (static_cast<double>(distance) * static_cast<double>(weight) + value * gain) / sum);
    weight = static_cast<float>(sum);
  }
};

/// The plain loop over voxels: a dense box of them, each looks up its pixel (Curless and Levoy
/// 1996; Newcombe et al. 2011).
class PlainVoxels {
 public:
  PlainVoxels(double voxel_size, double truncation, const Box& box);
  void integrate(const DepthImage& image, const PinholeCamera& camera,
                 const Eigen::Isometry3d& T_world_camera);
  TsdfMap map() const;

 private:
  std::size_t place(const VoxelIndex& v) const;

  double voxel_size_, truncation_;
  VoxelIndex low_, size_;
  std::vector<PlainVoxel> voxels_;
};

/// The plain loop over rays: every pixel walks its ray to behind the surface, voxel by voxel in a
/// hash table of blocks (Oleynikova et al. 2017, the simple integrator).
class PlainRays {
 public:
  PlainRays(double voxel_size, double truncation)
      : voxel_size_(voxel_size), truncation_(truncation) {}
  void integrate(const DepthImage& image, const PinholeCamera& camera,
                 const Eigen::Isometry3d& T_world_camera);
  TsdfMap map() const;

 private:
  double voxel_size_, truncation_;
  std::unordered_map<BlockIndex, std::vector<PlainVoxel>, BlockHash> blocks_;
};

}  // namespace ridgeway::detail
