// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <vector>

#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway::detail {

// What the searches over graphs share.

/// A vertex to go on from. In a std::priority_queue the top is the best; ties go by number.
struct OpenEntry {
  double estimate;  ///< cost, and what is left at least
  double cost;
  VertexId vertex;
  bool operator<(const OpenEntry& other) const {
    return estimate != other.estimate ? estimate > other.estimate : vertex > other.vertex;
  }
};

/// The vertices up to the last, back from each to the one `from` which it was reached.
template <typename State>
std::vector<VertexId> route_to(VertexId last, const std::vector<State>& states) {
  std::vector<VertexId> route;
  for (VertexId v = last; v != kNoVertex; v = states[number(v)].from) route.push_back(v);
  std::reverse(route.begin(), route.end());
  return route;
}

}  // namespace ridgeway::detail
