// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// A* over the sparse graph's edges that are free at a radius; lengths as costs, times
/// `penalty[edge]` where that is given, none below 1. Vertices from start to goal; empty where
/// there is no way.
std::vector<VertexId> search_graph(const SparseGraph& graph, const Landmarks& landmarks,
                                   VertexId start, VertexId goal, double radius,
                                   const std::vector<float>* penalty = nullptr);

/// The edge between two adjacent vertices.
EdgeId edge_between(const SparseGraph& graph, VertexId a, VertexId b);

}  // namespace ridgeway::detail
