// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "attach_way.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway::detail {

/// Two places that moves between voxels connect at a radius, each with its way to the graph.
struct CellQuery {
  Point start, goal;
  const AttachWay& from;
  const AttachWay& to;
  double radius;
};

/// A short route over the cell graph, every segment of it free at the radius: A* with a weighted
/// heuristic. An end that sees none of the cells that the other one can reach follows its way until
/// it does. Empty where there is none, or none within the search's limit, which says nothing about
/// space.
std::vector<Point> search_cells(const Roadmap& roadmap, const FreeSpace& space,
                                const CellQuery& query);

}  // namespace ridgeway::detail
