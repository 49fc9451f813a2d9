// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>

#include "query_file.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "ridgeway/planning/plan.hpp"

namespace ridgeway::cli {

/// The voxel states that a roadmap was built from.
OccupancyMap occupancy_of(const EsdfMap& esdf);

/// Largest radius, up to the query's, at which its places are connected; nothing where they are
/// not even at the roadmap's smallest. Found by planning, in about ten queries.
std::optional<double> connecting_radius(const Roadmap& roadmap, const Query& query);

/// A sentence on why there is no path and what to do. `file`: the roadmap's, to be named.
std::string explain(const Roadmap& roadmap, const Query& query, PlanStatus status,
                    const std::string& file);

}  // namespace ridgeway::cli
