// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/live/graph_delta.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "paths/world_rounding.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"

namespace ridgeway {
namespace {

using detail::radius_less_rounding;

/// By name, ascending.
template <typename Name>
using Clearances = std::vector<std::pair<Name, double>>;

template <typename Name>
Clearances<Name> in_order(Clearances<Name> clearances) {
  if (!std::is_sorted(clearances.begin(), clearances.end()))
    std::sort(clearances.begin(), clearances.end());
  return clearances;
}

Clearances<VoxelIndex> vertices_of(const Roadmap& roadmap) {
  Clearances<VoxelIndex> vertices;
  vertices.reserve(roadmap.graph.vertices.size());
  for (const Vertex& vertex : roadmap.graph.vertices)
    vertices.emplace_back(roadmap.esdf.origin + vertex.voxel, vertex.clearance);
  return in_order(std::move(vertices));
}

Clearances<EdgeName> edges_of(const Roadmap& roadmap) {
  const auto name = [&](VertexId id) {
    return roadmap.esdf.origin + roadmap.graph.vertices[number(id)].voxel;
  };
  Clearances<EdgeName> edges;
  edges.reserve(roadmap.graph.edges.size());
  for (const Edge& edge : roadmap.graph.edges) {
    const VoxelIndex a = name(edge.from), b = name(edge.to);
    edges.push_back({{std::min(a, b), std::max(a, b)}, edge.clearance});
  }
  return in_order(std::move(edges));
}

template <typename Name>
void compare(const Clearances<Name>& before, const Clearances<Name>& now, std::vector<Name>& came,
             std::vector<Name>& gone, std::vector<Name>& changed) {
  auto old = before.begin();
  for (const auto& [name, clearance] : now) {
    for (; old != before.end() && old->first < name; ++old) gone.push_back(old->first);
    if (old == before.end() || name < old->first) {
      came.push_back(name);
      continue;
    }
    if (old->second != clearance) changed.push_back(name);
    ++old;
  }
  for (; old != before.end(); ++old) gone.push_back(old->first);
}

/// The voxels of a block where a robot may not be any more, or that it has to keep away from now.
/// Null states: the map has no such block. There nothing is open, under any policy: where unknown
/// space is free it ends with the box of the blocks.
void find_closed(const VoxelIndex& first, const VoxelState* old, const VoxelState* states,
                 UnknownPolicy policy, std::vector<VoxelIndex>& closed) {
  if (old == states) return;  // the same memory
  if (old != nullptr && states != nullptr &&
      std::memcmp(old, states, kBlockVoxels * sizeof(VoxelState)) == 0)
    return;
  for (int v = 0; v < kBlockVoxels; ++v) {
    const VoxelState was = old == nullptr ? VoxelState::kUnknown : old[v];
    const VoxelState is = states == nullptr ? VoxelState::kUnknown : states[v];
    const bool was_open = old != nullptr && is_open(was, policy);
    if ((was_open && (states == nullptr || !is_open(is, policy))) ||
        (!is_obstacle(was, policy) && is_obstacle(is, policy)))
      closed.push_back(first + voxel_of({}, v));
  }
}

/// The same, of all blocks of two maps, in (z, y, x) order.
std::vector<VoxelIndex> closed_between(const EsdfMap& before, const EsdfMap& now) {
  std::vector<VoxelIndex> closed;
  const auto first_of = [&](const BlockIndex& block) { return now.origin + voxel_of(block, 0); };
  // Snapshots that follow each other mostly have a block in the same slot.
  const auto slot_in = [](const BlockLayout& layout, std::uint32_t slot, const BlockIndex& block) {
    return slot < layout.block_count() && layout.block(slot) == block ? slot
                                                                      : layout.find_block(block);
  };
  bool all_stayed = true;
  for (std::uint32_t slot = 0; slot < before.layout.block_count(); ++slot) {
    const BlockIndex& block = before.layout.block(slot);
    const std::uint32_t other = slot_in(now.layout, slot, block);
    all_stayed = all_stayed && other == slot;
    find_closed(first_of(block), before.state.block(slot),
                other == BlockLayout::kNoBlock ? nullptr : now.state.block(other), now.unknown,
                closed);
  }
  const std::uint32_t first_new = all_stayed ? before.layout.block_count() : 0;
  for (std::uint32_t slot = first_new; slot < now.layout.block_count(); ++slot)
    if (const BlockIndex& block = now.layout.block(slot);
        slot_in(before.layout, slot, block) == BlockLayout::kNoBlock)
      find_closed(first_of(block), nullptr, now.state.block(slot), now.unknown, closed);
  std::sort(closed.begin(), closed.end());
  return closed;
}

/// Squared distance from a point to a segment, metres^2.
double squared_distance(const Point& p, const Point& a, const Point& b) {
  const Eigen::Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + t * along - p).squaredNorm();
}

/// What is no number compares as neither near nor far.
void require_path(std::span<const Point> path, double radius, double voxel_size) {
  if (path.empty()) throw InputError("path", "has no point", "give one at least");
  // The last voxel that a map may have lies as far from the world's zero, its places a little more.
  const double farthest = (kMaxVoxelIndex + 1.0) * voxel_size;
  for (const Point& p : path)
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > farthest)
      throw InputError("path", "has a point that is no place of the map", "give finite metres");
  if (!(radius >= 0.0 && std::isfinite(radius)))
    throw InputError("radius", "is no distance", "give metres, 0 or more");
}

const PlannedFor& robot_of(const PlanResult& path) {
  if (!path.ok() || path.planned_for.radius == 0.0)
    throw InputError("path", path.ok() ? "is not said to be for a robot" : "is none",
                     "give what plan() found, or points and a radius");
  return path.planned_for;
}

bool is_free(const FreeSpace& space, std::span<const Point> path_world, double radius) {
  std::vector<Point> path;
  for (const Point& p : path_world) path.push_back(flight_place(space.map(), p));
  if (!space.is_free(path.front(), radius)) return false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (!space.is_free(path[i], path[i + 1], radius)) return false;
  return true;
}

}  // namespace

GraphDelta delta_between(const Roadmap& before, const Roadmap& now) {
  const EsdfMap &a = before.esdf, &b = now.esdf;
  if (a.voxel_size != b.voxel_size || a.origin != b.origin || a.unknown != b.unknown ||
      a.planar != b.planar)
    throw InputError("roadmaps", "are of maps with another voxel size, origin, policy or shape",
                     "compare snapshots of one live roadmap");
  GraphDelta delta;
  delta.voxel_size = b.voxel_size;
  delta.planar = b.planar;
  compare(vertices_of(before), vertices_of(now), delta.came_vertices, delta.gone_vertices,
          delta.changed_vertices);
  compare(edges_of(before), edges_of(now), delta.came_edges, delta.gone_edges, delta.changed_edges);
  delta.closed = closed_between(a, b);
  return delta;
}

bool may_be_invalid(std::span<const Point> path, double radius, const GraphDelta& delta) {
  if (!(delta.voxel_size > 0.0))
    throw InputError("delta", "is of no two maps", "give what delta_between() returns");
  require_path(path, radius, delta.voxel_size);
  // A cube lies within half its diagonal around its centre; a voxel more for rounding in the world.
  const double reach = radius + (1.0 + 0.5 * std::sqrt(3.0)) * delta.voxel_size;
  const auto in_map = [&](Point p) {
    if (delta.planar) p.z() = 0.0;  // the one layer stands for all heights
    return p;
  };
  return std::any_of(delta.closed.begin(), delta.closed.end(), [&](const VoxelIndex& voxel) {
    const Point centre = in_map(centre_of(voxel, delta.voxel_size));
    for (std::size_t i = 0; i < path.size(); ++i)
      if (squared_distance(centre, in_map(path[i]),
                           in_map(path[std::min(i + 1, path.size() - 1)])) < reach * reach)
        return true;
    return false;
  });
}

bool may_be_invalid(const PlanResult& path, const GraphDelta& delta) {
  const PlannedFor& robot = robot_of(path);
  return may_be_invalid(path.waypoints, std::hypot(robot.radius, 0.5 * robot.robot_height), delta);
}

bool still_safe(std::span<const Point> path, double radius, const Roadmap& now) {
  require_path(path, radius, now.esdf.voxel_size);
  return is_free(FreeSpace(now.esdf), path, radius_less_rounding(radius, path));
}

bool still_safe(const PlanResult& path, const Roadmap& now) {
  const auto& [radius, height, limits_world] = robot_of(path);
  require_path(path.waypoints, radius, now.esdf.voxel_size);
  const FlightLimits limits = both_of(now.esdf.limits, limits_in_local(now.esdf, limits_world));
  std::span<const Point> points = path.waypoints;
  const auto escape_is_free = [&](std::span<const Point> leg, const Escape& escape) {
    return is_free(FreeSpace(now.esdf, limits), leg,
                   radius_less_rounding(escape.clearance, path.waypoints));
  };
  if (path.escape_start.length > 0.0) {
    if (!escape_is_free(points.first(2), path.escape_start)) return false;
    points = points.subspan(1);
  }
  if (path.escape_goal.length > 0.0) {
    if (!escape_is_free(points.last(2), path.escape_goal)) return false;
    points = points.first(points.size() - 1);
  }
  return is_free(FreeSpace(now.esdf, limits, radius, height), points,
                 radius_less_rounding(radius, points));
}

}  // namespace ridgeway
