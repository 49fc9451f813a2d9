// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "ridgeway/esdf/free_space.hpp"
#include "roadmap/attach_way.hpp"
#include "viewpoints.hpp"

namespace ridgeway::detail {

/// Where a place joins the graph.
struct Access {
  VertexId vertex = kNoVertex;
  double length = 0.0;  ///< of the way there, over voxels, metres
};

inline Access access_of(const Roadmap& roadmap, VoxelId voxel) {
  const AttachWay way = follow_attach(roadmap, voxel, roadmap.min_clearance);
  double steps = 0.0;
  for (std::size_t i = 1; i < way.voxels.size(); ++i) {
    const VoxelIndex step = roadmap.esdf.layout.index_of(way.voxels[i]) -
                            roadmap.esdf.layout.index_of(way.voxels[i - 1]);
    steps += std::sqrt(step.x * step.x + step.y * step.y + step.z * step.z);
  }
  return {way.vertex, steps * roadmap.esdf.voxel_size};
}

/// Lengths of ways along the roadmap from one point to all others: one search.
class WaysFrom {
 public:
  WaysFrom(const Roadmap& roadmap, const Point& from, const Access& access)
      : roadmap_(roadmap), from_(from) {
    if (access.vertex != kNoVertex)
      along_ = lengths_from(roadmap.graph, {{access.vertex, access.length}}, roadmap.min_clearance);
  }
  /// Infinite where there is none. Straight where that is free.
  double to(const Point& point, const Access& access) const {
    if (FreeSpace(roadmap_.esdf).is_clearly_free(from_, point, roadmap_.min_clearance))
      return (point - from_).norm();
    if (access.vertex == kNoVertex || along_.empty())
      return std::numeric_limits<double>::infinity();
    return along_[number(access.vertex)] + access.length;
  }

 private:
  const Roadmap& roadmap_;
  Point from_;
  std::vector<double> along_;
};

}  // namespace ridgeway::detail
