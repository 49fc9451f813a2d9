// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/sparse_graph.hpp"
#include "ridgeway/roadmap/tangent_graph.hpp"
#include "ridgeway/skeleton/basins.hpp"
#include "ridgeway/voxel/voxel_mask.hpp"

namespace ridgeway {

/// The one-voxel-wide curves along the ridges of the distance field that the graph is fitted to.
struct SkeletonDiagram {
  VoxelMask voxels;      ///< on the ESDF's layout
  bool complete = true;  ///< connected as space is; false for the paper's edges alone
};

/// Way of every traversable voxel to the graph, widest first: the direction of its next voxel, a
/// byte each. Following it never passes a place narrower than any other way would have to.
struct AttachField {
  static constexpr Direction kHere = kCentre;  ///< a vertex stands here, or the way ends here
  /// No way: the robot does not fit here.
  static constexpr Direction kNotTraversable = ridgeway::kNotTraversable;
  VoxelField<Direction> next;  ///< on the ESDF's layout
};

/// At which clearance do two vertices part? A forest over the vertices: `parent` (itself at a
/// root), and the clearance and place of the narrowest point of the widest way to the parent.
/// Climbing it takes a number of steps logarithmic in the number of vertices.
struct ClearanceTree {
  std::vector<VertexId> parent;   ///< by vertex; itself at a root
  std::vector<double> clearance;  ///< metres; 0 at a root
  std::vector<VoxelIndex> place;  ///< where the way to the parent is narrowest
};

/// All of traversable space, coarsely: cubes of 4 x 4 x 4 voxels, in each one place to pass,
/// further ones (nooks) where moves inside do not reach it, straight segments between the places of
/// neighbouring cells, and bends where such a segment is not free. Where space is open it knows the
/// sides on which obstacles can be passed, at any radius, which curves through the middle of space
/// do not. At the smallest radius it connects what moves across faces connect; for wider robots
/// narrow places may be missing: there voxels and the sparse graph decide.
/// Not in the file: found when a roadmap is built or loaded. Empty for a planar map.
struct CellGraph {
  static constexpr int kSide = 4;                   ///< of a cell, voxels
  static constexpr int kPerBlock = 8;               ///< cells
  static constexpr std::uint8_t kNoPlace = 64;      ///< of a cell in which the robot fits nowhere
  static constexpr std::uint16_t kNoPart = 0xffff;  ///< no part, or one of too many
  static constexpr std::size_t kLevels = 4;  ///< of radii: 1, 1.25, 1.5 and 2 times the smallest

  /// A cell: its place, and which of the cells around it are in sight.
  struct Cell {
    std::uint8_t place = kNoPlace;  ///< the voxel in the cell, x fastest
    /// How many of the radii the edges in the directions 14 to 26 (voxel/neighbourhood.hpp) let
    /// through; 0: no edge. The cell beyond has those of the others.
    std::array<std::uint8_t, 13> widths{};
    bool has_bends = false;       ///< whether `bends` has some from it
    std::uint8_t all_around = 0;  ///< how many of the radii all 26 edges let through
    /// Connected parts of this graph, of the edges and bends that let each of these radii through.
    std::array<std::uint16_t, kLevels> parts{kNoPart, kNoPart, kNoPart, kNoPart};
  };
  std::vector<Cell> cells;  ///< by block in order (BlockLayout::rank), then x, y, z in the block

  /// A further place of a cell, for voxels that moves in the cell do not connect with its first
  /// one: narrow passages side by side. Places are numbered on from the cells.
  struct Nook {
    std::uint32_t cell = 0;         ///< its place in `cells`
    std::uint8_t place = kNoPlace;  ///< the voxel in the cell, x fastest
    /// As of a cell.
    std::array<std::uint16_t, kLevels> parts{kNoPart, kNoPart, kNoPart, kNoPart};
  };
  std::vector<Nook> nooks;  ///< by ascending cell

  /// A way round a corner between places of two cells that share a face: moves across faces of
  /// voxels within the two, which join what straight edges do not.
  struct Bend {
    std::uint32_t from = 0;  ///< place that it leads from; each bend is there in both directions
    std::uint32_t to = 0;    ///< place that it leads to
    float length = 0.0f;     ///< voxels
    std::uint8_t width = 0;  ///< how many of the radii it lets through
  };
  std::vector<Bend> bends;  ///< by ascending `from`, then `to`

  /// Lengths of ways from landmarks to each block, voxels, about: the way between two blocks is
  /// hardly shorter than the difference. By block in order; NaN where no way leads. Empty where no
  /// cells of two blocks are linked.
  static constexpr std::size_t kLandmarks = 3;
  /// Of one block: from each landmark.
  using Lengths = std::vector<std::array<float, kLandmarks>>;
  Lengths lengths;       ///< over all edges
  Lengths lengths_wide;  ///< over those of the widest robots

  /// Parts of open space, by block in order: moves between voxels connect all voxels of blocks that
  /// have the same number, at the smallest radius. kNotOpen where the robot does not fit on some
  /// voxel of the block: the numbers say nothing about that one.
  std::vector<std::uint32_t> open_parts;
  static constexpr std::uint32_t kNotOpen = 0xffffffffu;  ///< see open_parts
};

/// For robots of a radius of `min_clearance` metres and more. Every segment is verified by the
/// free-space predicate. Deterministic.
CellGraph build_cell_graph(const EsdfMap& esdf, double min_clearance);

/// Everything a query needs, in the local frame of `esdf`; to_world(esdf, point) and to_local lead
/// from it to the world and back; what is saved to and loaded from a `.ridge` file.
/// Immutable during queries: any number of threads may plan on one Roadmap.
struct Roadmap {
  EsdfMap esdf;                ///< distances, and what is known, in the map's local frame
  double min_clearance = 0.0;  ///< metres; smallest robot radius that may be asked for
  SkeletonDiagram diagram;     ///< what the graph was fitted to
  SparseGraph graph;           ///< vertices and straight, verified edges
  AttachField attach;          ///< from any traversable voxel to the graph
  ClearanceTree tree;          ///< at which radius two vertices part
  Landmarks landmarks;         ///< of the graph; not in the file, placed when it is loaded
  CellGraph cells;             ///< of the field; not in the file, found when it is loaded
  TangentGraph tangents;       ///< ways close around corners; may be empty
  bool is_settled = true;      ///< false: a LiveRoadmap's, its cells and tangents not learnt yet
  std::string source;          ///< the map it was built from, for people
  std::string config;          ///< the configuration it was built with, as JSON text, for people
};

}  // namespace ridgeway
