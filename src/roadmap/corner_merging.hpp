// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "corner_sampling.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Corners, and which of them follow each other on a path.
struct MergedCorners {
  std::vector<VoxelId> voxels;                                 ///< ascending
  std::vector<std::uint32_t> parts;                            ///< by corner, see SampledPath
  std::vector<std::pair<std::uint32_t, std::uint32_t>> steps;  ///< smaller first, ascending
};

/// Gathers the corners of paths, on the voxels nearest to them that are as far from obstacles. One
/// stands for all within a distance of it that it can stand for: paths over it stay free.
class CornerMerging {
 public:
  CornerMerging(const Roadmap& roadmap, double distance);

  void add(const SampledPath& path);
  MergedCorners merged() const;

 private:
  using Bucket = std::tuple<int, int, int>;

  Bucket bucket_of(const Point& p) const;
  VoxelId voxel_for(const Point& corner) const;
  std::uint32_t insert(VoxelId id, const Point& place, std::uint32_t part);
  std::uint32_t stand_in(const Point& corner, std::uint32_t part, const Point* before,
                         const Point& next) const;

  const EsdfMap& esdf_;
  const FreeSpace space_;
  const double radius_, distance_;
  std::vector<VoxelId> voxels_;
  std::vector<Point> places_;
  std::vector<std::uint32_t> parts_;
  std::map<Bucket, std::vector<std::uint32_t>> buckets_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> steps_;
};

}  // namespace ridgeway::detail
