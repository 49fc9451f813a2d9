// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <utility>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// A* over the sparse graph's edges that are free at a radius; lengths as costs, times
/// `penalty[edge]` where that is given. Vertices from start to goal; empty where there is no way.
std::vector<VertexId> search_graph(const SparseGraph& graph, VertexId start, VertexId goal,
                                   double radius, const std::vector<float>* penalty = nullptr);

/// Length from the nearest of some vertices, each `first` with the length `second` before it, to
/// every vertex, over edges that are free at a radius; infinite where there is no way. Dijkstra.
using Sources = std::vector<std::pair<VertexId, double>>;
std::vector<double> lengths_from(const SparseGraph& graph, const Sources& sources, double radius);

/// The edge between two adjacent vertices.
EdgeId edge_between(const SparseGraph& graph, VertexId a, VertexId b);

}  // namespace ridgeway::detail
