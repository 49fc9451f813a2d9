// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "ridgeway/planning/plan.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// An edge of the graph by the voxels of the lattice that its ends stand on, `from` before `to` in
/// (z, y, x) order. No two edges of a graph have the same.
struct EdgeName {
  VoxelIndex from;  ///< the lesser end
  VoxelIndex to;    ///< the greater end
  /// By `from`, then by `to`.
  friend constexpr auto operator<=>(const EdgeName&, const EdgeName&) = default;
};

/// What is different between two snapshots of a map. Vertices are named by their voxel of the
/// lattice, as their numbers are another in every snapshot. All lists ascend.
struct GraphDelta {
  std::vector<VoxelIndex> came_vertices;     ///< were not there before
  std::vector<VoxelIndex> gone_vertices;     ///< are not there any more
  std::vector<VoxelIndex> changed_vertices;  ///< have another clearance
  std::vector<EdgeName> came_edges;          ///< were not there before
  std::vector<EdgeName> gone_edges;          ///< are not there any more
  std::vector<EdgeName> changed_edges;       ///< have another clearance
  /// Voxels of the lattice where a robot might be and may not be any more, those included that the
  /// box of a map has left in which unknown space is free, or that are obstacles now and were none.
  std::vector<VoxelIndex> closed;
  double voxel_size = 0.0;  ///< metres
  bool planar = false;      ///< as of the maps: heights of paths say nothing

  /// Whether nothing is different.
  bool is_empty() const {
    return came_vertices.empty() && gone_vertices.empty() && changed_vertices.empty() &&
           came_edges.empty() && gone_edges.empty() && changed_edges.empty() && closed.empty();
  }
};

/// Compares two roadmaps of the same map, before and after it has changed. Throws InputError where
/// voxel size, origin or policy differ, or one is planar and the other is not.
GraphDelta delta_between(const Roadmap& before, const Roadmap& now);

/// Whether a path (metres, world) that was free at a radius before may not be so any more: whether
/// a voxel that has closed since comes near it. False is certain; where true, ask still_safe().
/// Takes no look at the map, so that it can be asked many times a second. Throws InputError for a
/// path without points or beyond all maps, and a radius that is no distance.
bool may_be_invalid(std::span<const Point> path, double radius, const GraphDelta& delta);
/// The same of a path of plan(), for the robot that it was planned for, escapes and all. Throws
/// InputError for a path that is none, or of which no robot is known (given_plan).
bool may_be_invalid(const PlanResult& path, const GraphDelta& delta);

/// Whether a sphere of a radius (metres) can move along a path (metres, world; at least one point),
/// by the one predicate that decides what is free (FreeSpace).
bool still_safe(std::span<const Point> path, double radius, const Roadmap& now);
/// Whether a path of plan() still holds for the robot and within the limits that it was planned
/// for, its escapes at the clearance that they had. Throws InputError for a path that is none, or
/// of which no robot is known (given_plan).
bool still_safe(const PlanResult& path, const Roadmap& now);

}  // namespace ridgeway
