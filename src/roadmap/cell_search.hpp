// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <limits>
#include <vector>

#include "attach_way.hpp"
#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Two places that moves between voxels connect at a radius, each with its way to the graph.
struct CellQuery {
  Point start, goal;
  const AttachWay& from;
  const AttachWay& to;
  double radius;
  double longest = std::numeric_limits<double>::infinity();  ///< routes of interest, metres
};

/// A route over cells.
struct CellRoute {
  std::vector<Point> waypoints;  ///< empty where there is none
  bool is_direct = false;        ///< both ends saw cells at once
};

/// A short route over the cell graph, every segment of it free at the radius: A* with a weighted
/// heuristic. An end that sees none of the cells that the other one can reach follows its way until
/// it does. Empty where there is none, or none within the search's limits, which says nothing about
/// space.
CellRoute search_cells(const Roadmap& roadmap, const FreeSpace& space, const CellQuery& query,
                       const Deadline& deadline);

/// About how long a way between two places is at least, metres, by the landmarks of the cell graph:
/// an estimate at no cost, not a bound. 0 where they say nothing.
double length_between(const Roadmap& roadmap, VoxelId a, VoxelId b, double radius);

}  // namespace ridgeway::detail
