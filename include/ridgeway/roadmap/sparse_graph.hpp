// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ridgeway/voxel/index.hpp"

namespace ridgeway {

/// The number of a vertex in its graph.
enum class VertexId : std::uint32_t {};
/// The number of an edge in its graph.
enum class EdgeId : std::uint32_t {};
inline constexpr VertexId kNoVertex{0xffffffffu};  ///< Stands for no vertex.
/// Its place in SparseGraph::vertices.
constexpr std::size_t number(VertexId id) { return static_cast<std::size_t>(id); }
/// Its place in SparseGraph::edges.
constexpr std::size_t number(EdgeId id) { return static_cast<std::size_t>(id); }

/// A vertex of the sparse graph, on a voxel of the diagram.
struct Vertex {
  VoxelIndex voxel;        ///< the diagram voxel it stands on, one of the map's own
  Point position;          ///< that voxel's centre, metres, in the map's local frame: to_world()
  double clearance = 0.0;  ///< distance to the nearest obstacle, metres
};

/// A straight edge of the sparse graph, free for every radius up to its clearance.
struct Edge {
  VertexId from{};         ///< from < to
  VertexId to{};           ///< the end with the larger number
  double length = 0.0;     ///< metres
  double clearance = 0.0;  ///< smallest distance to an obstacle along the whole segment, metres
};

/// One end of an edge as a vertex sees it.
struct Link {
  VertexId vertex{};  ///< the other end
  EdgeId edge{};      ///< which leads there
};

/// Vertices and straight, collision-free edges (paper: Sparse Graph Generation).
/// Contract: every edge is a straight segment whose clearance, all along it, is at least
/// `min_clearance`; there are no self-loops and no two edges between the same vertices; edges are
/// sorted by (from, to). Plain data; read-only use is thread-safe.
struct SparseGraph {
  double min_clearance = 0.0;             ///< metres
  std::vector<Vertex> vertices;           ///< by VertexId
  std::vector<Edge> edges;                ///< by EdgeId, sorted by (from, to)
  std::vector<std::uint32_t> first_link;  ///< vertices.size() + 1 entries into `links`
  std::vector<Link> links;                ///< of each vertex in one piece: see links_of

  /// All edges at a vertex.
  std::span<const Link> links_of(VertexId v) const {
    return std::span(links).subspan(first_link[number(v)],
                                    first_link[number(v) + 1] - first_link[number(v)]);
  }
};

/// Sorts the edges and fills `first_link` and `links` from them.
void index_links(SparseGraph& graph);

/// Label of the connected part each vertex belongs to, 0 .. count - 1, numbered by first vertex.
struct GraphComponents {
  std::vector<std::uint32_t> label;  ///< by vertex
  std::uint32_t count = 0;           ///< of connected parts
};
/// Takes time linear in vertices and edges.
GraphComponents connected_components(const SparseGraph& graph);

/// Vertices to start from, and the length that a way has before it comes there, metres.
using Sources = std::vector<std::pair<VertexId, double>>;
/// Length from the nearest of some vertices, with what it had before, to every vertex, metres, over
/// edges that are free at a radius; infinite where there is no way. Dijkstra.
std::vector<double> lengths_from(const SparseGraph& graph, const Sources& sources, double radius);

/// Lengths over the graph from a few vertices far apart, in each connected part its own. By the
/// triangle inequality they bound the length between any two vertices from below, much closer than
/// the straight line does (Goldberg and Harrelson, "Computing the shortest path: A* search meets
/// graph theory", 2005), at every radius: a wider robot has fewer edges, so longer ways.
struct Landmarks {
  static constexpr int kCount = 8;                  ///< landmarks, in each connected part
  std::vector<std::array<double, kCount>> lengths;  ///< by vertex, metres; may be empty: no bounds
};
/// Deterministic; takes a search over the graph for each landmark.
Landmarks place_landmarks(const SparseGraph& graph);

/// At most the length over the graph between two vertices that it connects, metres.
double length_bound(const Landmarks& landmarks, VertexId a, VertexId b);

}  // namespace ridgeway
