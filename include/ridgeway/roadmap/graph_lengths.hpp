// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "ridgeway/roadmap/sparse_graph.hpp"

namespace ridgeway {

/// Length from the nearest of some vertices, each `first` with the length `second` before it, to
/// every vertex, metres, over edges that are free at a radius; infinite where there is no way.
/// Dijkstra.
using Sources = std::vector<std::pair<VertexId, double>>;
std::vector<double> lengths_from(const SparseGraph& graph, const Sources& sources, double radius);

/// Lengths over the graph from a few vertices far apart, in each connected part its own. By the
/// triangle inequality they bound the length between any two vertices from below, much closer than
/// the straight line does (Goldberg and Harrelson, "Computing the shortest path: A* search meets
/// graph theory", 2005), at every radius: a wider robot has fewer edges, so longer ways.
struct Landmarks {
  static constexpr int kCount = 8;
  std::vector<std::array<double, kCount>> lengths;  ///< by vertex, metres; may be empty: no bounds
};
Landmarks place_landmarks(const SparseGraph& graph);

/// At most the length over the graph between two vertices that it connects, metres.
double length_bound(const Landmarks& landmarks, VertexId a, VertexId b);

}  // namespace ridgeway
