// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstddef>

namespace ridgeway::detail {

/// How hard voxels are searched that a search over cells guides.
struct GuidedEffort {
  int most_parts;   ///< of cells, taken before the guide gives up: half a microsecond each
  int most_voxels;  ///< taken before the search gives up: a thousand take a third of a millisecond
};

/// What queries, and the learning of corners for them, trade length against time by: nearly every
/// number that could as well be another one. Each says its unit and what more of it costs. Lengths
/// are in voxels or radii; `docs/performance.md` has what most are worth.
struct PlanningConstants {
  // The cell graph (roadmap/build_cell_graph.cpp, cell_search.cpp, cell_guide.cpp).
  double cell_room = 1.5;      ///< voxels beyond the widest radius that a cell's place may be wide
  double cell_centring = 0.5;  ///< voxels of width that a voxel off the middle is worth
  double cell_weight = 1.25;   ///< of A*'s heuristic: more is faster, its routes a little longer
  int most_cells = 3200;       ///< taken before a search gives up: a third of a microsecond each
  int cells_to_look = 4;       ///< gone on from between two looks straight ahead, at first
  double landmark_share = 0.93;  ///< of lengths by landmarks that paths are hardly shorter than

  // What a query tries (planning/answering.cpp, short_path.cpp, detour.cpp). The first three are
  // lengths over what a path may be expected to have.
  double near = 1.05;  ///< good enough: nothing else is asked, nor ways past what blocks it tried
  double doubtful = 1.12;  ///< voxels are searched
  double far = 1.15;       ///< too long to be believed: all else is searched as well
  double as_found = 1.1;   ///< a route over cells, corners or voxels over its tight path, at most
  int voxel_reach = 40;    ///< voxels that ends are apart at most for a search without a guide
  int unguided = 3700;     ///< voxels taken by that, which comes first: in clutter guides mislead
  /// The second where the first found no way, last of all.
  std::array<GuidedEffort, 2> guided{{{600, 3000}, {800000, 1200000}}};

  // Ways past what blocks a stretch (planning/detour.cpp).
  int detour_rays = 6;             ///< around the stretch
  double detour_offset = 1.4;      ///< times as far along a ray as the robot first fits
  std::size_t detour_stretch = 3;  ///< segments that a way may replace

  // Pulling tight (paths/shorten.cpp).
  int tight_bisections = 5;   ///< of a move
  double tight_gain = 2e-3;   ///< of the path's length: what a move must gain
  double corner_gain = 1e-2;  ///< the same between corners that were learnt tight

  // Where clearance is preferred, and alternatives (planning/path_cost.cpp, deformation.cpp,
  // alternatives.cpp, route_enumeration.cpp).
  double look_step = 0.5;         ///< radii between looks along a path
  double cost_slack = 1e-3;       ///< of a cost, by which its sum over looks may be off
  double deform_radius = 0.75;    ///< radii at which two paths see each other all along
  double shrinks_to = 0.6;        ///< of its length: shorter a route seldom becomes
  int shortenings = 3;            ///< of an alternative
  double apart = 4.0;             ///< radii along a path between places that may not meet
  std::size_t most_forks = 5000;  ///< gone on from before the enumeration gives up
  int most_alike = 4;             ///< routes to a fork that deform into each other

  // Learning corners (roadmap/build_tangent_graph.cpp, corner_*.cpp).
  std::size_t first_pairs = 250;  ///< of places to learn from at first
  std::size_t asked_pairs = 100;  ///< of places between which new paths show how much is known
  double known = 0.85;            ///< of the paths: enough is learnt
  double hopeless = 0.75;         ///< of the paths: less, and the map does without corners
  std::size_t linked = 16;        ///< nearest corners that one is linked to
  double over_tangent = 0.2;      ///< sine of the angle above a corner's tangent plane
  std::size_t looked_at = 72;     ///< corners from a region, for those that it sees
};

inline constexpr PlanningConstants kPlanning{};

/// Radii, over the smallest, that edges of the cell graph are looked at for.
inline constexpr std::array kRadiusLevels{1.0, 1.25, 1.5, 2.0};

}  // namespace ridgeway::detail
