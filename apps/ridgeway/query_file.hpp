// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <vector>

#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway::cli {

struct Query {
  Point start, goal;
  double radius = 0.0;  ///< metres

  friend bool operator==(const Query&, const Query&) = default;
};

/// Queries of a text file, x,y,z,x,y,z[,radius] a line; empty lines, comments after # and one line
/// of names are passed over. Throws InputError, naming the line, for anything else, for a radius
/// beyond `largest_radius`, and for a file without a query.
std::vector<Query> read_queries(const std::filesystem::path& file, double default_radius,
                                double largest_radius);

}  // namespace ridgeway::cli
