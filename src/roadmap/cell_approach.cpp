// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_approach.hpp"

#include <algorithm>

#include "cell_walks.hpp"
#include "paths/planning_constants.hpp"

namespace ridgeway::detail {
namespace {

std::uint8_t place_of_voxel(const VoxelIndex& v) {
  return static_cast<std::uint8_t>((v.x & 3) | (v.y & 3) << 2 | (v.z & 3) << 4);
}

}  // namespace

WidthsFor widths_for(double factor) {
  constexpr double kRounding = 1e-9;
  std::size_t least = 1;
  while (least < kRadiusLevels.size() && kRadiusLevels[least] <= factor * (1.0 + kRounding))
    ++least;
  const bool is_level = factor <= kRadiusLevels[least - 1] * (1.0 + kRounding);
  return {least, is_level ? least : least + 1};
}

CellsForRobot::CellsForRobot(const Roadmap& roadmap, const FreeSpace& free_space,
                             double robot_radius)
    : esdf(roadmap.esdf),
      graph(roadmap.cells),
      space(free_space),
      lattice(roadmap.esdf.layout),
      radius(robot_radius),
      threshold(least_clearance(robot_radius, roadmap.esdf.voxel_size)),
      widths(widths_for(robot_radius / roadmap.min_clearance)) {}

std::uint16_t CellsForRobot::part_of(CellId place) const {
  const std::size_t level = widths.least - 1;
  const std::size_t cells = graph.cells.size();
  return place < cells ? graph.cells[place].parts[level] : graph.nooks[place - cells].parts[level];
}

CellApproach::CellApproach(const CellsForRobot& cells, const Point& end, const AttachWay& way)
    : cells_(cells), end_(end), way_(way), place_(end), voxel_(way.voxels.front()) {
  look_around();
}

bool CellApproach::walk_on() {
  if (walked_ >= way_.voxels.size()) return false;
  walked_ = std::min(walked_ + CellGraph::kSide, way_.voxels.size());
  voxel_ = way_.voxels[walked_ - 1];
  place_ = point_of_voxel(voxel_);
  look_around();
  return true;
}

void CellApproach::look_around() {
  joins_.clear();
  const CellId own = cells_.lattice.cell_of(voxel_at(place_, cells_.esdf.voxel_size));
  for (int d = 0; d < 27 && own != kNoCell; ++d) {
    const CellId cell = cells_.lattice.neighbour(own, d);
    if (cell != kNoCell && cells_.part_of(cell) != CellGraph::kNoPart) add_join(cell);
  }
  look_inside();
  std::stable_sort(joins_.begin(), joins_.end(),
                   [](const Join& a, const Join& b) { return a.length < b.length; });
}

CellApproach::Join& CellApproach::add_join(CellId cell) {
  const double length = (cells_.point_of(cell) - place_).norm() / cells_.esdf.voxel_size;
  joins_.push_back({cell, static_cast<float>(length)});
  return joins_.back();
}

/// Moves in the place's own cell lead to one of its places, whatever is in sight.
void CellApproach::look_inside() {
  const CellGraph& graph = cells_.graph;
  const VoxelIndex v = cells_.esdf.layout.index_of(voxel_);
  const CellId cell = cells_.lattice.cell_of(v);
  const CellMask inside =
      flood(bit_of(place_of_voxel(v)), fitting_voxels(cells_.space, cell, cells_.threshold));
  const std::uint8_t own = graph.cells[cell].place;
  if (own != CellGraph::kNoPlace && (inside & bit_of(own)) != 0)
    for (Join& join : joins_) join.has_walk |= join.cell == cell;
  const PlaceRange nooks = nooks_of(graph, cell);
  for (CellId nook = nooks.first; nook < nooks.last; ++nook)
    if ((inside & bit_of(number_in_cell(graph, nook))) != 0 &&
        cells_.part_of(nook) != CellGraph::kNoPart)
      add_join(nook).has_walk = true;
}

/// The moves in its cell to the place of a join.
std::vector<std::uint8_t> CellApproach::walk_to(CellId place) const {
  const CellMask room =
      fitting_voxels(cells_.space, cell_of_place(cells_.graph, place), cells_.threshold);
  return CellWalks({room, 0}, 0)
      .walk(place_of_voxel(cells_.esdf.layout.index_of(voxel_)),
            number_in_cell(cells_.graph, place));
}

bool CellApproach::sees(Join& join) const {
  if (join.sight != Sight::kUnknown) return join.sight != Sight::kNo;
  if (cells_.space.is_free(place_, cells_.point_of(join.cell), cells_.radius)) {
    join.sight = Sight::kYes;
  } else if (join.has_walk) {
    join.sight = Sight::kWalk;
    const double before = (point_of_voxel(voxel_) - place_).norm();
    join.length =
        length_of_walk(walk_to(join.cell), 0) + static_cast<float>(before / cells_.esdf.voxel_size);
  } else {
    join.sight = Sight::kNo;
  }
  return join.sight != Sight::kNo;
}

std::vector<Point> CellApproach::way_to(CellId place) const {
  std::vector<Point> way{end_};
  for (std::size_t i = 0; i < walked_; ++i) way.push_back(point_of_voxel(way_.voxels[i]));
  const VoxelIndex first = cells_.first_voxel(place);
  for (const Join& join : joins_)
    if (join.cell == place && join.sight == Sight::kWalk)
      for (const std::uint8_t passed : walk_to(place))
        way.push_back(centre_of(first + step_to(passed, 0), cells_.esdf.voxel_size));
  return way;
}

bool have_common_part(const CellsForRobot& cells, CellApproach& a, CellApproach& b) {
  for (CellApproach::Join& x : a.joins())
    for (CellApproach::Join& y : b.joins())
      if (cells.part_of(x.cell) == cells.part_of(y.cell) && a.sees(x) && b.sees(y)) return true;
  return false;
}

}  // namespace ridgeway::detail
