// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstddef>
#include <vector>

#include "attach_way.hpp"
#include "cell_bends.hpp"
#include "cell_neighbours.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway::detail {

/// How many levels of radii an edge has to let through for a radius. Between two levels those of
/// the narrower may let it through, beyond all levels those of the widest, and have to be looked
/// at.
struct WidthsFor {
  std::size_t least;  ///< fewer: it does not let it through
  std::size_t sure;   ///< so many: it does
};
/// `factor`: the radius over the smallest.
WidthsFor widths_for(double factor);

/// The cell graph as a robot of some radius sees it.
struct CellsForRobot {
  const EsdfMap& esdf;
  const CellGraph& graph;
  const FreeSpace& space;
  CellLattice lattice;
  double radius;  ///< metres
  SquaredHalves threshold;
  WidthsFor widths;  ///< of its edges

  CellsForRobot(const Roadmap& roadmap, const FreeSpace& free_space, double robot_radius);

  /// The first voxel of the cell of a place.
  VoxelIndex first_voxel(CellId place) const {
    return lattice.first_voxel(cell_of_place(graph, place));
  }
  /// Where a cell, or a nook of one, is passed, metres.
  Point point_of(CellId place) const {
    return centre_of(lattice.voxel_at(cell_of_place(graph, place), number_in_cell(graph, place)),
                     esdf.voxel_size);
  }
  /// Connected part of the graph by all edges that may let the robot through.
  std::uint16_t part_of(CellId place) const;
};

/// Places of cells around a place on the way from an end to the graph. Whether they are in sight of
/// it is looked at only where that counts.
class CellApproach {
 public:
  enum class Sight : std::uint8_t { kUnknown, kYes, kWalk, kNo };
  struct Join {
    CellId cell;            ///< or a nook of it
    float length;           ///< of the segment to its place, or of the walk, voxels
    bool has_walk = false;  ///< moves within the cell lead there
    Sight sight = Sight::kUnknown;
  };

  /// Around the end itself. All three must outlive it.
  CellApproach(const CellsForRobot& cells, const Point& end, const AttachWay& way);

  /// Looks around from a cell farther along the way; false at its end.
  bool walk_on();
  /// Voxels of the way that lead to the place; 0: it is the end itself.
  std::size_t walked() const { return walked_; }

  std::vector<Join>& joins() { return joins_; }  ///< the nearest first
  /// Whether the place of a cell is in sight, or reached by a walk.
  bool sees(Join& join) const;
  /// From the end to the place of a cell that it sees, without that place, metres.
  std::vector<Point> way_to(CellId place) const;

 private:
  void look_around();
  Join& add_join(CellId cell);
  void look_inside();
  std::vector<std::uint8_t> walk_to(CellId place) const;
  Point point_of_voxel(VoxelId id) const {
    return centre_of(cells_.esdf.layout.index_of(id), cells_.esdf.voxel_size);
  }

  const CellsForRobot& cells_;
  const Point end_;
  const AttachWay& way_;
  Point place_;    // metres
  VoxelId voxel_;  // that it joins
  std::size_t walked_ = 0;
  std::vector<Join> joins_;
};

/// Whether two ends see places that the graph connects.
bool have_common_part(const CellsForRobot& cells, CellApproach& a, CellApproach& b);

}  // namespace ridgeway::detail
