// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// A part of a roadmap that would break a query, and what is wrong with it.
struct RoadmapDefect {
  std::string part;  ///< a section's name
  std::string what;
};

/// Looks for sizes that do not fit each other: all that saving relies on.
std::optional<RoadmapDefect> find_size_defect(const Roadmap& roadmap);

/// Looks for indices out of range, numbers that are not finite, edges out of order, a vertex or a
/// narrowest place in no allocated block, a clearance tree that goes in circles, a way of the
/// attach field that leaves traversable space or never ends. The links need not be there yet.
std::optional<RoadmapDefect> find_graph_defect(const Roadmap& roadmap);
/// The same of the tangent graph.
std::optional<RoadmapDefect> find_tangent_defect(const Roadmap& roadmap);
std::optional<RoadmapDefect> find_attach_defect(const Roadmap& roadmap);
/// Looks for traversable voxels without a way of the attach field, and for others with one. States
/// and distances must be right.
std::optional<RoadmapDefect> find_unattached_defect(const Roadmap& roadmap);

/// Looks for layers of a planar map that are not alike. Sizes must be right.
std::optional<RoadmapDefect> find_planar_defect(const Roadmap& roadmap);

/// Looks for sites that are no obstacles, and for voxels that are nearer to the site of one of
/// their six neighbours than to their own. Linear in voxels, in parallel. Sizes and states must be
/// right, and the squared distances those of the sites.
std::optional<RoadmapDefect> find_site_defect(const Roadmap& roadmap);

}  // namespace ridgeway
