// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <filesystem>
#include <string>

#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// The writers below replace the file whole or not at all (atomic_file.hpp) and throw InputError
/// where it cannot be written. Lengths and clearances in metres, positions in the world frame;
/// numbers read back as they were.

/// JSON as networkx.node_link_graph reads it: "nodes" with id, x, y, z, clearance; "links" with
/// source, target, length, clearance. "graph" holds min_clearance.
void write_graph_json(const Roadmap& roadmap, const std::filesystem::path& path);

/// GraphML with typed keys, as networkx.read_graphml and Gephi read it; nodes are n0, n1, ...
void write_graph_graphml(const Roadmap& roadmap, const std::filesystem::path& path);

/// Binary PLY: vertices (x, y, z, clearance, colour by clearance) and edges (vertex1, vertex2,
/// clearance). Positions are doubles.
void write_graph_ply(const Roadmap& roadmap, const std::filesystem::path& path);

/// Binary PLY: the diagram's voxel centres as points with clearance and colour by clearance.
void write_diagram_ply(const Roadmap& roadmap, const std::filesystem::path& path);

/// The sparse graph file of voxblox's skeletons (docs/formats.md); vertices are numbered from 0,
/// subgraphs are the connected parts, the distances of edges are the clearances at their ends.
void write_graph_voxblox(const Roadmap& roadmap, const std::filesystem::path& path);

/// voxblox layers: the field as an ESDF, then the diagram as a skeleton; distances are clearances,
/// those of occupied voxels minus half a voxel.
void write_voxblox(const Roadmap& roadmap, const std::filesystem::path& path);

/// A voxblox layer: the fused field as a TSDF.
void write_voxblox(const TsdfMap& map, const std::filesystem::path& path);

/// Writes the graph in the format that the file's extension names: .json, .graphml, .ply or .pb.
/// Throws InputError for another one.
void write_graph(const Roadmap& roadmap, const std::filesystem::path& path);

/// Binary PLY: vertices (x, y, z as doubles in metres, nx, ny, nz) and triangles. The file is
/// replaced whole or not at all; throws InputError where it cannot be written.
void write_mesh_ply(const SurfaceMesh& mesh, const std::filesystem::path& path);

}  // namespace ridgeway
