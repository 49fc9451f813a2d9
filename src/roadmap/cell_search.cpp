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

/// A cell that a search has met.
struct MetCell {
  CellId from = kNoCell;
  /// Of the best way to it, voxels; minus infinity once ways go on from it, as it is final then.
  float cost = std::numeric_limits<float>::infinity();
  float rest = -1.0f;  ///< of the way to the goal, about, voxels; below 0: not known yet
};

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
    is_direct_ = out.walked() == 0 && in.walked() == 0;
    looks_ahead_ = is_direct_ && around_.space.is_for_sphere();  // each takes long for a cylinder
    const CellId last = search(out, in);
    CellRoute result{{}, is_direct_};
    if (last != kNoCell) result.waypoints = route_over(out, in, last);
    return result;
  }

 private:
  using Place = Eigen::Vector3f;  // voxels
  using MetBlock = MetCells<MetCell>::Block;

  /// Where a cell is passed that begins at a voxel.
  Place place_in(CellId cell, const VoxelIndex& first) const {
    const int place = number_in_cell(graph_, cell);
    return {static_cast<float>(first.x + (place & 3)) + 0.5f,
            static_cast<float>(first.y + (place >> 2 & 3)) + 0.5f,
            static_cast<float>(first.z + (place >> 4)) + 0.5f};
  }
  Place place_of(CellId cell) const { return place_in(cell, around_.first_voxel(cell)); }

  struct Open {
    Open(float estimate, float cost_there, CellId cell, Direction back_to)
        : order(std::uint64_t{std::bit_cast<std::uint32_t>(estimate)} << 32 | cell),
          cost(cost_there),
          back(back_to) {}
    CellId cell() const { return static_cast<CellId>(order); }
    float estimate() const { return std::bit_cast<float>(static_cast<std::uint32_t>(order >> 32)); }
    bool operator<(const Open& other) const { return order > other.order; }  // the top is the best

    /// The estimate's bits, which ascend with floats from 0 on, then the cell.
    std::uint64_t order;
    float cost;
    std::uint32_t back;  ///< direction to the cell before it, if all 26 edges of that are free
  };

  void aim_at(CellId goal) {
    if (lengths_.empty()) return;
    goal_lengths_ = lengths_[cell_of_place(graph_, goal) / CellGraph::kPerBlock];
  }

  /// Of the way to the goal from a block, about, voxels, by landmarks; 0 where they do not tell.
  float rest_by_landmarks(std::uint32_t block) const {
    if (lengths_.empty()) return 0.0f;
    constexpr auto kShare = static_cast<float>(kPlanning.landmark_share);
    const auto& own = lengths_[block];
    float rest = 0.0f;
    for (std::size_t k = 0; k < own.size(); ++k)  // what is no number does not count
      rest = std::max(rest, kShare * std::abs(own[k] - goal_lengths_[k]));
    return rest;
  }
  /// The same from a place of a cell.
  float rest_from(CellId cell) const {
    const std::uint32_t block = cell_of_place(graph_, cell) / CellGraph::kPerBlock;
    return std::max((place_of(cell) - goal_).norm(), rest_by_landmarks(block));
  }

  void reach(float cost, CellId from, CellId cell, MetCell& met, Direction back = kCentre) {
    met.cost = cost;
    met.from = from;
    open_.emplace(cost + static_cast<float>(kPlanning.cell_weight) * met.rest, cost, cell, back);
  }

  /// The last cell of the best route found, or kNoCell. No cell is gone on from twice: estimates by
  /// landmarks are not consistent, and better ways to what is behind gain less than they cost.
  CellId search(CellApproach& out, CellApproach& in) {
    for (CellApproach::Join& join : out.joins())
      if (out.sees(join)) {
        MetCell& met = met_[join.cell];
        met.rest = rest_from(join.cell);
        reach(join.length, join.cell, join.cell, met);
      }
    constexpr int kSeldom = 16;  // searches that go on for long look more and more seldom
    float best = longest_;
    CellId best_last = kNoCell;
    int next_look = 0;
    for (int taken = 0; !open_.empty() && taken < kPlanning.most_cells; ++taken) {
      if (deadline_.has_passed(taken)) break;
      const Open next = open_.top();
      open_.pop();
      const CellId cell = next.cell();
      if (best_last != kNoCell && next.estimate() >= best) break;
      MetCell& met = met_[cell];
      if (next.cost > met.cost) continue;
      met.cost = kFinal;
      if (looks_ahead_ && taken >= next_look) {
        next_look = taken + std::max(kPlanning.cells_to_look, taken / kSeldom);
        if (const float length = look_ahead(cell, next.cost, best); length < best) {
          best = length;
          best_last = cell;
        }
      }
      for (CellApproach::Join& join : in.joins())
        if (join.cell == cell && next.cost + join.length < best && in.sees(join) &&
            next.cost + join.length < best) {  // a walk is longer than a segment
          best = next.cost + join.length;
          best_last = cell;
        }
      if (cell < cells_.size()) expand(cell, next, best);
      if (cell >= cells_.size() || cells_[cell].has_bends) follow_bends(cell, next.cost, best);
    }
    return best_last;
  }

  /// Blocks that hold a cell and those beside it, by the axes along which they are other ones than
  /// its own (OctantStep::crossed): places in met_, kNoBlock for those that do not exist.
  using Around = std::array<std::uint32_t, 8>;

  /// Finds those in some directions, and has the memory fetch what is known of their cells: all at
  /// once, as much of a search is waiting for it.
  Around meet_around(CellId cell, Cube27 directions) {
    constexpr std::uint32_t kNotAsked = BlockLayout::kNoBlock - 1;
    Around around;
    around.fill(kNotAsked);
    std::array<std::uint32_t, 8> numbers;
    for (; directions != 0; directions &= directions - 1) {
      const OctantStep& step = CellLattice::step_from(cell, std::countr_zero(directions));
      std::uint32_t& place = around[step.crossed];
      std::uint32_t& number = numbers[step.crossed];
      if (place == kNotAsked) {
        number = lattice_.block_beside(cell, step);
        place = number == BlockLayout::kNoBlock ? number : met_.meet(number);
        if (place != BlockLayout::kNoBlock && !lengths_.empty())
          __builtin_prefetch(&lengths_[number]);
      }
      if (place != BlockLayout::kNoBlock)
        __builtin_prefetch(&cells_[number * CellGraph::kPerBlock + step.octant]);
    }
    return around;
  }

  /// `best`: length that ways have to stay below, voxels.
  void expand(CellId here, const Open& open, float best) {
    const Cube27 directions = kBeyondParent[open.back];
    const Around around = meet_around(here, directions);
    const VoxelIndex first = lattice_.first_voxel(here);
    const Place place = place_in(here, first);
    const bool is_open = cells_[here].all_around >= widths_.sure;
    for (Cube27 left = directions; left != 0; left &= left - 1) {
      const int d = std::countr_zero(left);
      const OctantStep& step = CellLattice::step_from(here, d);
      if (around[step.crossed] == BlockLayout::kNoBlock) continue;
      MetBlock& block = met_.block(around[step.crossed]);
      const CellId next = block.number * CellGraph::kPerBlock + step.octant;
      const std::size_t width = is_open ? widths_.sure : edge_width(cells_, here, next, d);
      if (width < widths_.least) continue;
      MetCell& met = block.cells[step.octant];
      if (open.cost >= met.cost) continue;  // as most have
      const VoxelIndex& o = offset_of(d);
      const Place there =
          place_in(next, first + VoxelIndex{CellGraph::kSide * o.x, CellGraph::kSide * o.y,
                                            CellGraph::kSide * o.z});
      const float cost = open.cost + (there - place).norm();
      if (cost >= met.cost) continue;
      if (met.rest < 0.0f) {
        if (block.bound < 0.0f) block.bound = rest_by_landmarks(block.number);
        met.rest = std::max((there - goal_).norm(), block.bound);
      }
      if (cost + met.rest < best && (width >= widths_.sure || is_free(here, next)))
        reach(cost, here, next, met, is_open ? static_cast<Direction>(opposite(d)) : kCentre);
    }
  }

  /// Looks from a cell towards the goal: the length of the way to it if it is in sight, else
  /// infinite. Then a cell near the end of what is free becomes a neighbour, as most ways lead
  /// straight through open space from one obstacle to the next.
  float look_ahead(CellId here, float cost_here, float best) {
    const Point from = around_.point_of(here), ahead = query_.goal - from;
    const double whole = ahead.norm();
    const double free = around_.space.clear_length(from, query_.goal, query_.radius);
    if (free >= whole) return cost_here + static_cast<float>(whole / voxel_size_);
    constexpr float kNotInSight = std::numeric_limits<float>::infinity();
    constexpr double kShare = 0.9;
    constexpr int kLeast = kPlanning.cells_to_look * CellGraph::kSide;  // as cells lead as far
    if (kShare * free < kLeast * voxel_size_) return kNotInSight;
    const Point end = from + kShare * free / whole * ahead;
    const CellId cell = lattice_.cell_of(voxel_at(end, voxel_size_));
    if (cell == kNoCell || around_.part_of(cell) == CellGraph::kNoPart) return kNotInSight;
    const Point there = around_.point_of(cell);
    const float cost = cost_here + static_cast<float>((there - from).norm() / voxel_size_);
    MetCell& met = met_[cell];
    if (cost >= met.cost) return kNotInSight;
    if (met.rest < 0.0f) met.rest = rest_from(cell);
    if (cost + met.rest < best && around_.space.is_clearly_free(from, there, query_.radius))
      reach(cost, here, cell, met);
    return kNotInSight;
  }

  void follow_bends(CellId here, float cost_here, float best) {
    for (const CellGraph::Bend& bend : bends_from(graph_, here)) {
      if (bend.width < widths_.sure) continue;
      const float cost = cost_here + bend.length;
      MetCell& met = met_[bend.to];
      if (cost >= met.cost) continue;
      if (met.rest < 0.0f) met.rest = rest_from(bend.to);
      if (cost + met.rest < best) reach(cost, here, bend.to, met);
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

  /// Whether the straight way between two places is one that the search has taken.
  bool has_edge(CellId a, CellId b) const {
    const VoxelIndex step = around_.first_voxel(b) - around_.first_voxel(a);
    if (std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)}) > CellGraph::kSide)
      return true;  // what a look has found
    if (a >= cells_.size() || b >= cells_.size()) return false;
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
  bool is_direct_ = false, looks_ahead_ = false;
  MetCells<MetCell> met_;
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
