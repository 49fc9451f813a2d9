// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// A sparse graph file of the original, as it is.
struct VoxbloxGraph {
  struct Vertex {
    std::int64_t id = 0;
    Point place = Point::Zero();      ///< metres
    std::vector<std::int64_t> edges;  ///< ids
    std::int64_t subgraph = 0;
  };
  struct Edge {
    std::int64_t id = 0, from = 0, to = 0;
    Point start = Point::Zero(), end = Point::Zero();  ///< metres
    float start_distance = 0.0f, end_distance = 0.0f;  ///< metres; of recent files 0
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
};

/// What is wrong in such a graph: how many of each.
struct VoxbloxGraphFaults {
  std::size_t doubled_ids = 0;     ///< vertices or edges with the id of one before
  std::size_t self_loops = 0;      ///< edges from a vertex to itself
  std::size_t doubled_edges = 0;   ///< edges between two vertices that one before joins
  std::size_t dangling_edges = 0;  ///< edges of a vertex that is not there
  std::size_t misplaced_ends = 0;  ///< ends of edges more than 1 mm from their vertex
  std::size_t unlisted_edges = 0;  ///< edges that one of their vertices does not list
  std::size_t lone_vertices = 0;   ///< vertices without an edge
  std::size_t not_finite = 0;      ///< vertices and edges with a place that is no number
  std::size_t components = 0;      ///< connected parts
};

/// Does a file begin like one?
bool is_voxblox_graph(std::string_view bytes);

/// Throws InputError naming file and byte.
VoxbloxGraph read_voxblox_graph(std::string_view bytes, const std::string& name);

std::string voxblox_graph_bytes(const VoxbloxGraph& graph);

VoxbloxGraphFaults find_faults(const VoxbloxGraph& graph);

}  // namespace ridgeway
