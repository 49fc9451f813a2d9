// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <queue>

#include "cell_approach.hpp"
#include "cell_bends.hpp"
#include "cell_neighbours.hpp"
#include "cell_walks.hpp"
#include "met_cells.hpp"
#include "paths/planning_constants.hpp"
#include "voxel/beyond_parent.hpp"

namespace ridgeway::detail {
namespace {

constexpr float kFinal = -std::numeric_limits<float>::infinity();

const CellGraph::Lengths& lengths_for(const CellGraph& cells, double factor) {
  return widths_for(factor).least == kRadiusLevels.size() ? cells.lengths_wide : cells.lengths;
}

class CellSearch {
 public:
  CellSearch(const Roadmap& roadmap, const FreeSpace& space, const CellQuery& query,
             const Deadline& deadline)
      : around_(roadmap, space, query.radius),
        graph_(roadmap.cells),
        cells_(roadmap.cells.cells),
        query_(query),
        deadline_(deadline),
        lattice_(roadmap.esdf.layout),
        voxel_size_(roadmap.esdf.voxel_size),
        widths_(around_.widths),
        lengths_(lengths_for(roadmap.cells, query.radius / roadmap.min_clearance)),
        goal_((query.goal / voxel_size_).cast<float>()),
        longest_(static_cast<float>(query.longest / voxel_size_)) {}

  CellRoute run() {
    CellApproach out(around_, query_.start, query_.from), in(around_, query_.goal, query_.to);
    while (!have_common_part(around_, out, in)) {
      const bool can_walk = out.walk_on();
      if (!in.walk_on() && !can_walk) return {};
    }
    aim_at(in.joins().front().cell);
    const CellId last = search(out, in);
    CellRoute result{{}, out.walked() == 0 && in.walked() == 0};
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
  Place place_of(CellId cell) const { return place_in(cell, around_.first_voxel(cell)); }

  struct Open {
    float estimate, cost;
    CellId cell;
    Direction back = kCentre;  ///< to the cell before it, if all 26 edges of that are free
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

  void reach(float cost, CellId from, MetCell& met, Direction back = kCentre) {
    met.cost = cost;
    met.from = from;
    open_.push({cost + static_cast<float>(kPlanning.cell_weight) * met.rest, cost, met.cell, back});
  }

  /// The last cell of the best route found, or kNoCell. No cell is gone on from twice: estimates by
  /// landmarks are not consistent, and better ways to what is behind gain less than they cost.
  CellId search(CellApproach& out, CellApproach& in) {
    for (CellApproach::Join& join : out.joins())
      if (out.sees(join)) {
        MetCell& met = met_[join.cell];
        met.rest = rest_from(join.cell, place_of(join.cell));
        reach(join.length, join.cell, met);
      }
    float best = longest_;
    CellId best_last = kNoCell;
    for (int taken = 0; !open_.empty() && taken < kPlanning.most_cells; ++taken) {
      if (deadline_.has_passed(taken)) break;
      const Open next = open_.top();
      open_.pop();
      if (best_last != kNoCell && next.estimate >= best) break;
      MetCell& met = met_[next.cell];
      if (next.cost > met.cost) continue;
      met.cost = kFinal;
      for (CellApproach::Join& join : in.joins())
        if (join.cell == next.cell && next.cost + join.length < best && in.sees(join) &&
            next.cost + join.length < best) {  // a walk is longer than a segment
          best = next.cost + join.length;
          best_last = next.cell;
        }
      if (next.cell < cells_.size()) expand(next, best);
      if (next.cell >= cells_.size() || cells_[next.cell].has_bends) follow_bends(next, best);
    }
    return best_last;
  }

  /// Cells beside one, by direction.
  using Around = std::array<CellId, 27>;

  /// Finds those in some directions, and has the memory fetch what is known of them: all at once,
  /// as most of a search is waiting for it.
  void fetch_around(CellId cell, Cube27 directions, Around& around) const {
    for (; directions != 0; directions &= directions - 1) {
      const int d = std::countr_zero(directions);
      const CellId next = lattice_.neighbour(cell, d);
      around[static_cast<std::size_t>(d)] = next;
      if (next == kNoCell) continue;
      __builtin_prefetch(&cells_[next]);
      if (!lengths_.empty()) __builtin_prefetch(&lengths_[next / CellGraph::kPerBlock]);
    }
  }

  /// `best`: length that ways have to stay below, voxels.
  void expand(const Open& here, float best) {
    const Cube27 directions = kBeyondParent[here.back];
    Around around;
    fetch_around(here.cell, directions, around);
    const VoxelIndex first = lattice_.first_voxel(here.cell);
    const Place place = place_in(here.cell, first);
    const bool is_open = cells_[here.cell].all_around >= widths_.sure;
    for (Cube27 left = directions; left != 0; left &= left - 1) {
      const int d = std::countr_zero(left);
      const CellId next = around[static_cast<std::size_t>(d)];
      if (next == kNoCell) continue;
      const std::size_t width = is_open ? widths_.sure : edge_width(cells_, here.cell, next, d);
      if (width < widths_.least) continue;
      MetCell& met = met_[next];
      if (here.cost >= met.cost) continue;  // as most have
      const VoxelIndex& o = offset_of(d);
      const Place there =
          place_in(next, first + VoxelIndex{CellGraph::kSide * o.x, CellGraph::kSide * o.y,
                                            CellGraph::kSide * o.z});
      const float cost = here.cost + (there - place).norm();
      if (cost >= met.cost) continue;
      if (met.rest < 0.0f) met.rest = rest_from(next, there);
      if (cost + met.rest < best && (width >= widths_.sure || is_free(here.cell, next)))
        reach(cost, here.cell, met, is_open ? static_cast<Direction>(opposite(d)) : kCentre);
    }
  }

  void follow_bends(const Open& here, float best) {
    for (const CellGraph::Bend& bend : bends_from(graph_, here.cell)) {
      if (bend.width < widths_.sure) continue;
      const float cost = here.cost + bend.length;
      MetCell& met = met_[bend.to];
      if (cost >= met.cost) continue;
      if (met.rest < 0.0f) met.rest = rest_from(bend.to, place_of(bend.to));
      if (cost + met.rest < best) reach(cost, here.cell, met);
    }
  }

  /// By the distances at both ends, if they tell.
  bool is_free(CellId a, CellId b) const {
    const EsdfMap& esdf = around_.esdf;
    const SquaredHalves from = esdf.known_squared(voxel_of(a)),
                        to = esdf.known_squared(voxel_of(b));
    if (std::min(from, to) < around_.threshold) return false;
    const VoxelIndex o = lattice_.voxel_at(b, number_in_cell(graph_, b)) -
                         lattice_.voxel_at(a, number_in_cell(graph_, a));
    if (esdf.unknown == UnknownPolicy::kObstacle &&
        FreeSpace::move_bound(from, to, o.x * o.x + o.y * o.y + o.z * o.z) >= around_.threshold)
      return true;
    return around_.space.is_free(around_.point_of(a), around_.point_of(b), query_.radius);
  }

  VoxelId voxel_of(CellId cell) const {
    return around_.esdf.layout.slot_at(cell / CellGraph::kPerBlock) * kBlockVoxels +
           local_voxel(cell, number_in_cell(graph_, cell));
  }

  std::vector<Point> route_over(const CellApproach& out, const CellApproach& in, CellId last) {
    std::vector<Point> route = in.way_to(last);
    CellId cell = last;
    for (;; cell = met_[cell].from) {
      route.push_back(around_.point_of(cell));
      if (met_[cell].from == cell) break;
      if (has_edge(cell, met_[cell].from)) continue;
      for (const VoxelIndex& v :
           way_over_bend(graph_, around_.space, cell, met_[cell].from, around_.threshold))
        route.push_back(centre_of(v, voxel_size_));
    }
    const std::vector<Point> way = out.way_to(cell);
    route.insert(route.end(), way.rbegin(), way.rend());
    std::reverse(route.begin(), route.end());
    return route;
  }

  bool has_edge(CellId a, CellId b) const {
    if (a >= cells_.size() || b >= cells_.size()) return false;
    const VoxelIndex step = around_.first_voxel(b) - around_.first_voxel(a);
    const int d = direction_of(
        {step.x / CellGraph::kSide, step.y / CellGraph::kSide, step.z / CellGraph::kSide});
    const std::size_t width = edge_width(cells_, a, b, d);
    return width >= widths_.sure || (width >= widths_.least && is_free(a, b));
  }

  const CellsForRobot around_;
  const CellGraph& graph_;
  const std::vector<CellGraph::Cell>& cells_;
  const CellQuery& query_;
  const Deadline& deadline_;
  const CellLattice lattice_;
  const double voxel_size_;
  const WidthsFor widths_;
  const CellGraph::Lengths& lengths_;
  std::array<float, CellGraph::kLandmarks> goal_lengths_{};
  const Place goal_;
  const float longest_;
  MetCells<> met_;
  std::priority_queue<Open> open_;
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

CellRoute search_cells(const Roadmap& roadmap, const FreeSpace& space, const CellQuery& query,
                       const Deadline& deadline) {
  if (roadmap.cells.cells.empty()) return {};
  return CellSearch(roadmap, space, query, deadline).run();
}

}  // namespace ridgeway::detail
