// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "cell_bends.hpp"
#include "cell_neighbours.hpp"
#include "cell_walks.hpp"
#include "met_cells.hpp"
#include "paths/planning_constants.hpp"

namespace ridgeway::detail {
namespace {

/// Places of cells around a place on the way from an end. Whether they are in sight of it is looked
/// at only where that counts.
struct Approach {
  enum class Sight : std::uint8_t { kUnknown, kYes, kWalk, kNo };
  struct Join {
    CellId cell;            ///< or a nook of it
    float length;           ///< of the segment to its place, or of the walk, voxels
    bool has_walk = false;  ///< moves within the cell lead there
    Sight sight = Sight::kUnknown;
  };
  Point place;              ///< metres
  VoxelId voxel;            ///< that it joins
  std::size_t walked = 0;   ///< voxels of the way that lead to the place; 0: the end itself
  std::vector<Join> joins;  ///< the nearest first
};

/// How many levels of radii an edge has to let through for a radius over the smallest; the widest
/// have to be looked at beyond all levels.
std::size_t width_for(double factor) {
  std::size_t width = 1;
  while (width < kRadiusLevels.size() && factor > kRadiusLevels[width - 1] * (1.0 + 1e-9)) ++width;
  return width;
}

const CellGraph::Lengths& lengths_for(const CellGraph& cells, double factor) {
  return width_for(factor) == kRadiusLevels.size() ? cells.lengths_wide : cells.lengths;
}

class CellSearch {
 public:
  CellSearch(const Roadmap& roadmap, const FreeSpace& space, const CellQuery& query)
      : esdf_(roadmap.esdf),
        graph_(roadmap.cells),
        cells_(roadmap.cells.cells),
        space_(space),
        query_(query),
        lattice_(roadmap.esdf.layout),
        threshold_(least_clearance(query.radius, roadmap.esdf.voxel_size)),
        is_beyond_levels_(query.radius >
                          kRadiusLevels.back() * roadmap.min_clearance * (1.0 + 1e-9)),
        least_width_(width_for(query.radius / roadmap.min_clearance)),
        lengths_(lengths_for(roadmap.cells, query.radius / roadmap.min_clearance)),
        goal_((query.goal / roadmap.esdf.voxel_size).cast<float>()),
        longest_(static_cast<float>(query.longest / roadmap.esdf.voxel_size)) {}

  CellRoute run() {
    Approach out = look_around(query_.start, query_.from.voxels.front(), 0);
    Approach in = look_around(query_.goal, query_.to.voxels.front(), 0);
    while (!have_common_part(out, in)) {
      const bool can_walk = walk_on(query_.from, out);
      if (!walk_on(query_.to, in) && !can_walk) return {};
    }
    aim_at(in.joins.front().cell);
    const CellId last = search(out, in);
    CellRoute result{
        {}, last != kNoCell, out.walked == 0 && in.walked == 0, taken_ >= query_.effort.most_cells};
    if (last != kNoCell) result.waypoints = route_over(out, in, last);
    return result;
  }

 private:
  using Place = Eigen::Vector3f;  // voxels

  /// Where a cell is passed that begins at a voxel.
  Place place_in(CellId cell, const VoxelIndex& first) const {
    const int place = number_in_cell(graph_, cell);
    return {static_cast<float>(first.x + (place & 3)) + 0.5f,
            static_cast<float>(first.y + (place >> 2 & 3)) + 0.5f,
            static_cast<float>(first.z + (place >> 4)) + 0.5f};
  }
  VoxelIndex first_voxel(CellId cell) const {
    return lattice_.first_voxel(cell_of_place(graph_, cell));
  }
  Place place_of(CellId cell) const { return place_in(cell, first_voxel(cell)); }
  std::uint16_t part_of(CellId cell) const {
    const std::size_t level = least_width_ - 1;
    return cell < cells_.size() ? cells_[cell].parts[level]
                                : graph_.nooks[cell - cells_.size()].parts[level];
  }
  Point point_of(CellId cell) const {
    return centre_of(lattice_.voxel_at(cell_of_place(graph_, cell), number_in_cell(graph_, cell)),
                     esdf_.voxel_size);
  }
  Point point_of_voxel(VoxelId id) const {
    return centre_of(esdf_.layout.index_of(id), esdf_.voxel_size);
  }

  Approach look_around(const Point& place, VoxelId voxel, std::size_t walked) const {
    Approach approach{place, voxel, walked, {}};
    const CellId own = lattice_.cell_of(voxel_at(place, esdf_.voxel_size));
    for (int d = 0; d < 27 && own != kNoCell; ++d) {
      const CellId cell = lattice_.neighbour(own, d);
      if (cell != kNoCell && part_of(cell) != CellGraph::kNoPart) add_join(cell, approach);
    }
    look_inside(approach);
    std::stable_sort(
        approach.joins.begin(), approach.joins.end(),
        [](const Approach::Join& a, const Approach::Join& b) { return a.length < b.length; });
    return approach;
  }

  Approach::Join& add_join(CellId cell, Approach& approach) const {
    const double length = (point_of(cell) - approach.place).norm() / esdf_.voxel_size;
    approach.joins.push_back({cell, static_cast<float>(length)});
    return approach.joins.back();
  }

  /// Moves in the place's own cell lead to one of its places, whatever is in sight.
  void look_inside(Approach& approach) const {
    const VoxelIndex v = esdf_.layout.index_of(approach.voxel);
    const CellId cell = lattice_.cell_of(v);
    const CellMask inside =
        flood(bit_of(place_of_voxel(v)), fitting_voxels(space_, cell, threshold_));
    if (cells_[cell].place != CellGraph::kNoPlace && (inside & bit_of(cells_[cell].place)) != 0)
      for (Approach::Join& join : approach.joins) join.has_walk |= join.cell == cell;
    const PlaceRange nooks = nooks_of(graph_, cell);
    for (CellId nook = nooks.first; nook < nooks.last; ++nook)
      if ((inside & bit_of(number_in_cell(graph_, nook))) != 0 &&
          part_of(nook) != CellGraph::kNoPart)
        add_join(nook, approach).has_walk = true;
  }

  static std::uint8_t place_of_voxel(const VoxelIndex& v) {
    return static_cast<std::uint8_t>((v.x & 3) | (v.y & 3) << 2 | (v.z & 3) << 4);
  }

  /// The moves in its cell to the place of a join.
  std::vector<std::uint8_t> walk_to(const Approach& approach, CellId place) const {
    const CellMask room = fitting_voxels(space_, cell_of_place(graph_, place), threshold_);
    return CellWalks({room, 0}, 0)
        .walk(place_of_voxel(esdf_.layout.index_of(approach.voxel)), number_in_cell(graph_, place));
  }

  /// Or reaches it by a walk.
  bool sees(const Approach& approach, Approach::Join& join) const {
    if (join.sight != Approach::Sight::kUnknown) return join.sight != Approach::Sight::kNo;
    if (space_.is_free(approach.place, point_of(join.cell), query_.radius)) {
      join.sight = Approach::Sight::kYes;
    } else if (join.has_walk) {
      join.sight = Approach::Sight::kWalk;
      const double before = (point_of_voxel(approach.voxel) - approach.place).norm();
      join.length = length_of_walk(walk_to(approach, join.cell), 0) +
                    static_cast<float>(before / esdf_.voxel_size);
    } else {
      join.sight = Approach::Sight::kNo;
    }
    return join.sight != Approach::Sight::kNo;
  }

  /// Looks around from a cell farther along the way; false at its end.
  bool walk_on(const AttachWay& way, Approach& approach) const {
    if (approach.walked >= way.voxels.size()) return false;
    const std::size_t walked = std::min(approach.walked + CellGraph::kSide, way.voxels.size());
    const VoxelId voxel = way.voxels[walked - 1];
    approach = look_around(point_of_voxel(voxel), voxel, walked);
    return true;
  }

  bool have_common_part(Approach& a, Approach& b) const {
    for (Approach::Join& x : a.joins)
      for (Approach::Join& y : b.joins)
        if (part_of(x.cell) == part_of(y.cell) && sees(a, x) && sees(b, y)) return true;
    return false;
  }

  struct Open {
    float estimate, cost;
    CellId cell;
    bool operator<(const Open& other) const {  // the queue's top is the best
      return estimate != other.estimate ? estimate > other.estimate : cell > other.cell;
    }
  };

  void aim_at(CellId goal) {
    if (lengths_.empty()) return;
    goal_lengths_ = lengths_[cell_of_place(graph_, goal) / CellGraph::kPerBlock];
  }

  /// Of the way to the goal, about, voxels.
  float rest_from(CellId cell, const Place& place) const {
    float rest = (place - goal_).norm();
    if (lengths_.empty()) return rest;
    constexpr auto kShare = static_cast<float>(kPlanning.landmark_share);
    const auto& own = lengths_[cell_of_place(graph_, cell) / CellGraph::kPerBlock];
    for (std::size_t k = 0; k < own.size(); ++k)  // what is no number does not count
      rest = std::max(rest, kShare * std::abs(own[k] - goal_lengths_[k]));
    return rest;
  }

  void reach(float cost, CellId from, MetCells::Met& met) {
    met.cost = cost;
    met.from = from;
    open_.push({cost + static_cast<float>(query_.effort.weight) * met.rest, cost, met.cell});
  }

  /// The last cell of the best route found, or kNoCell.
  CellId search(Approach& out, Approach& in) {
    for (Approach::Join& join : out.joins)
      if (sees(out, join)) {
        MetCells::Met& met = met_[join.cell];
        met.rest = rest_from(join.cell, place_of(join.cell));
        reach(join.length, join.cell, met);
      }
    float best = longest_;
    CellId best_last = kNoCell;
    for (; !open_.empty() && taken_ < query_.effort.most_cells; ++taken_) {
      const Open next = open_.top();
      open_.pop();
      if (best_last != kNoCell && next.estimate >= best) break;
      if (next.cost > met_[next.cell].cost) continue;
      for (Approach::Join& join : in.joins)
        if (join.cell == next.cell && next.cost + join.length < best && sees(in, join) &&
            next.cost + join.length < best) {  // a walk is longer than a segment
          best = next.cost + join.length;
          best_last = next.cell;
        }
      if (next.cell < cells_.size()) expand(next, best);
      if (!is_beyond_levels_ && (next.cell >= cells_.size() || cells_[next.cell].has_bends))
        follow_bends(next, best);
    }
    return best_last;
  }

  /// `best`: length that ways have to stay below, voxels.
  void expand(const Open& here, float best) {
    const VoxelIndex first = lattice_.first_voxel(here.cell);
    const Place place = place_in(here.cell, first);
    for (int d = 0; d < 27; ++d) {
      if (d == kCentre) continue;
      const CellId next = lattice_.neighbour(here.cell, d);
      if (next == kNoCell) continue;
      const std::size_t width = edge_width(cells_, here.cell, next, d);
      if (width < least_width_) continue;
      const VoxelIndex& o = offset_of(d);
      const Place there =
          place_in(next, first + VoxelIndex{CellGraph::kSide * o.x, CellGraph::kSide * o.y,
                                            CellGraph::kSide * o.z});
      const float cost = here.cost + (there - place).norm();
      MetCells::Met& met = met_[next];
      if (cost >= met.cost) continue;  // as most have
      if (met.rest < 0.0f) met.rest = rest_from(next, there);
      if (cost + met.rest < best && (!is_beyond_levels_ || is_free(here.cell, next)))
        reach(cost, here.cell, met);
    }
  }

  void follow_bends(const Open& here, float best) {
    for (const CellGraph::Bend& bend : bends_from(graph_, here.cell)) {
      if (bend.width < least_width_) continue;
      const float cost = here.cost + bend.length;
      MetCells::Met& met = met_[bend.to];
      if (cost >= met.cost) continue;
      if (met.rest < 0.0f) met.rest = rest_from(bend.to, place_of(bend.to));
      if (cost + met.rest < best) reach(cost, here.cell, met);
    }
  }

  bool is_free(CellId a, CellId b) const {
    return space_.is_free(point_of(a), point_of(b), query_.radius);
  }

  std::vector<Point> route_over(const Approach& out, const Approach& in, CellId last) {
    std::vector<Point> route{query_.goal};
    for (std::size_t i = 0; i < in.walked; ++i)
      route.push_back(point_of_voxel(query_.to.voxels[i]));
    std::vector<Point> walk = end_walk(in, last);
    route.insert(route.end(), walk.begin(), walk.end());
    CellId cell = last;
    for (;; cell = met_[cell].from) {
      route.push_back(point_of(cell));
      if (met_[cell].from == cell) break;
      if (has_edge(cell, met_[cell].from)) continue;
      for (const VoxelIndex& v : way_over_bend(graph_, space_, cell, met_[cell].from, threshold_))
        route.push_back(centre_of(v, esdf_.voxel_size));
    }
    walk = end_walk(out, cell);
    route.insert(route.end(), walk.rbegin(), walk.rend());
    for (std::size_t i = out.walked; i-- > 0;)
      route.push_back(point_of_voxel(query_.from.voxels[i]));
    route.push_back(query_.start);
    std::reverse(route.begin(), route.end());
    return route;
  }

  /// The moves from an end to the place of a cell that it does not see.
  std::vector<Point> end_walk(const Approach& approach, CellId place) const {
    std::vector<Point> walk;
    const VoxelIndex first = first_voxel(place);
    for (const Approach::Join& join : approach.joins)
      if (join.cell == place && join.sight == Approach::Sight::kWalk)
        for (const std::uint8_t passed : walk_to(approach, place))
          walk.push_back(centre_of(first + step_to(passed, 0), esdf_.voxel_size));
    return walk;
  }

  bool has_edge(CellId a, CellId b) const {
    if (a >= cells_.size() || b >= cells_.size()) return false;
    const VoxelIndex step = first_voxel(b) - first_voxel(a);
    const int d = direction_of(
        {step.x / CellGraph::kSide, step.y / CellGraph::kSide, step.z / CellGraph::kSide});
    return edge_width(cells_, a, b, d) >= least_width_;
  }

  const EsdfMap& esdf_;
  const CellGraph& graph_;
  const std::vector<CellGraph::Cell>& cells_;
  const FreeSpace& space_;
  const CellQuery& query_;
  const CellLattice lattice_;
  const SquaredHalves threshold_;
  const bool is_beyond_levels_;  ///< edges may be free that the widest robots pass
  const std::size_t least_width_;
  const CellGraph::Lengths& lengths_;
  std::array<float, CellGraph::kLandmarks> goal_lengths_{};
  const Place goal_;
  const float longest_;
  MetCells met_;
  std::priority_queue<Open> open_;
  int taken_ = 0;  ///< cells
};

}  // namespace

double length_between(const Roadmap& roadmap, VoxelId a, VoxelId b, double radius) {
  const CellGraph::Lengths& lengths = lengths_for(roadmap.cells, radius / roadmap.min_clearance);
  if (lengths.empty()) return 0.0;
  const auto& from = lengths[roadmap.esdf.layout.rank(a / kBlockVoxels)];
  const auto& to = lengths[roadmap.esdf.layout.rank(b / kBlockVoxels)];
  float length = 0.0f;
  for (std::size_t k = 0; k < from.size(); ++k)  // what is no number does not count
    length = std::max(length, std::abs(from[k] - to[k]));
  // Between the middles of two blocks: the ends may be nearer to each other.
  return kPlanning.landmark_share * std::max(length - kBlockSide, 0.0f) * roadmap.esdf.voxel_size;
}

CellRoute search_cells(const Roadmap& roadmap, const FreeSpace& space, const CellQuery& query) {
  if (roadmap.cells.cells.empty()) return {};
  return CellSearch(roadmap, space, query).run();
}

}  // namespace ridgeway::detail
