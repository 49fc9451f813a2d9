// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cell_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "cell_neighbours.hpp"
#include "paths/planning_constants.hpp"

namespace ridgeway::detail {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// What a search knows of the cells that it has met: a hash table, as they are few of many.
class MetCells {
 public:
  struct Met {
    CellId cell = kNoCell, from = kNoCell;
    float cost = kFar;  ///< voxels
  };

  Met& operator[](CellId cell) {
    if (2 * count_ >= table_.size()) grow();
    return place_of(cell);
  }

 private:
  Met& place_of(CellId cell) {
    std::size_t i = cell * 2654435761u & (table_.size() - 1);  // Knuth's multiplicative hash
    while (table_[i].cell != cell) {
      if (table_[i].cell == kNoCell) {
        table_[i].cell = cell;
        ++count_;
        break;
      }
      i = (i + 1) & (table_.size() - 1);
    }
    return table_[i];
  }

  void grow() {
    std::vector<Met> old(4 * table_.size());
    old.swap(table_);
    count_ = 0;
    for (const Met& met : old)
      if (met.cell != kNoCell) place_of(met.cell) = met;
  }

  std::vector<Met> table_ = std::vector<Met>(512);
  std::size_t count_ = 0;
};

/// Cells in sight of a place on the way from an end.
struct Approach {
  struct Join {
    CellId cell;
    float length;  ///< of the segment to its place, voxels
  };
  std::size_t walked = 0;   ///< voxels of the way that lead to the place; 0: the end itself
  std::vector<Join> joins;  ///< by direction from the place's own cell
};

class CellSearch {
 public:
  CellSearch(const Roadmap& roadmap, const FreeSpace& space, const CellQuery& query)
      : esdf_(roadmap.esdf),
        cells_(roadmap.cells.cells),
        space_(space),
        query_(query),
        lattice_(roadmap.esdf.layout),
        least_code_(static_cast<int>(
            std::ceil(CellGraph::kCodesPerRadius * query.radius / roadmap.min_clearance - 1e-6))),
        goal_((query.goal / roadmap.esdf.voxel_size).cast<float>()) {}

  std::vector<Point> run() {
    Approach out = look_around(query_.start, 0), in = look_around(query_.goal, 0);
    while (!have_common_part(out, in)) {
      const bool can_walk = walk_on(query_.from, out);
      if (!walk_on(query_.to, in) && !can_walk) return {};
    }
    const CellId last = search(out.joins, in.joins);
    return last == kNoCell ? std::vector<Point>{} : route_over(out, in, last);
  }

 private:
  using Place = Eigen::Vector3f;  // voxels

  Place place_of(CellId cell) const {
    const VoxelIndex v = lattice_.voxel_at(cell, cells_[cell].place);
    return {static_cast<float>(v.x) + 0.5f, static_cast<float>(v.y) + 0.5f,
            static_cast<float>(v.z) + 0.5f};
  }
  Point point_of(CellId cell) const {
    return centre_of(lattice_.voxel_at(cell, cells_[cell].place), esdf_.voxel_size);
  }
  Point point_of_voxel(VoxelId id) const {
    return centre_of(esdf_.layout.index_of(id), esdf_.voxel_size);
  }

  Approach look_around(const Point& place, std::size_t walked) const {
    Approach approach{walked, {}};
    const CellId own = lattice_.cell_of(voxel_at(place, esdf_.voxel_size));
    for (int d = 0; d < 27 && own != kNoCell; ++d) {
      const CellId cell = lattice_.neighbour(own, d);
      if (cell == kNoCell || cells_[cell].part == CellGraph::kNoPart) continue;
      const Point there = point_of(cell);
      if (space_.is_free(place, there, query_.radius))
        approach.joins.push_back(
            {cell, static_cast<float>((there - place).norm() / esdf_.voxel_size)});
    }
    return approach;
  }

  /// Looks around from a cell farther along the way; false at its end.
  bool walk_on(const AttachWay& way, Approach& approach) const {
    if (approach.walked >= way.voxels.size()) return false;
    const std::size_t walked = std::min(approach.walked + CellGraph::kSide, way.voxels.size());
    Approach next = look_around(point_of_voxel(way.voxels[walked - 1]), walked);
    approach = std::move(next);
    return true;
  }

  bool have_common_part(const Approach& a, const Approach& b) const {
    return std::any_of(a.joins.begin(), a.joins.end(), [&](const Approach::Join& x) {
      return std::any_of(b.joins.begin(), b.joins.end(), [&](const Approach::Join& y) {
        return cells_[x.cell].part == cells_[y.cell].part;
      });
    });
  }

  struct Open {
    float estimate, cost;
    CellId cell;
    bool operator<(const Open& other) const {  // the queue's top is the best
      return estimate != other.estimate ? estimate > other.estimate : cell > other.cell;
    }
  };

  void reach(CellId cell, const Place& place, float cost, CellId from) {
    MetCells::Met& met = met_[cell];
    if (cost >= met.cost) return;
    met.cost = cost;
    met.from = from;
    const float rest = (place - goal_).norm();
    open_.push({cost + static_cast<float>(kPlanning.cell_weight) * rest, cost, cell});
  }

  /// The last cell of the best route found, or kNoCell.
  CellId search(const std::vector<Approach::Join>& first, const std::vector<Approach::Join>& last) {
    for (const Approach::Join& join : first)
      reach(join.cell, place_of(join.cell), join.length, join.cell);
    float best = kFar;
    CellId best_last = kNoCell;
    for (int taken = 0; !open_.empty() && taken < kPlanning.most_cells; ++taken) {
      const Open next = open_.top();
      open_.pop();
      if (next.estimate >= best) break;
      if (next.cost > met_[next.cell].cost) continue;
      for (const Approach::Join& join : last)
        if (join.cell == next.cell && next.cost + join.length < best) {
          best = next.cost + join.length;
          best_last = next.cell;
        }
      expand(next);
    }
    return best_last;
  }

  void expand(const Open& here) {
    const Place place = place_of(here.cell);
    for (int d = 0; d < 27; ++d) {
      if (d == kCentre) continue;
      const CellId next = lattice_.neighbour(here.cell, d);
      if (next == kNoCell) continue;
      const int code = edge_code(cells_, here.cell, next, d);
      if (code == 0) continue;
      const Place there = place_of(next);
      const float cost = here.cost + (there - place).norm();
      if (cost < met_[next].cost && (code >= least_code_ || is_free(here.cell, next)))
        reach(next, there, cost, here.cell);
    }
  }

  /// The clearance that edges know is rounded down, and often a bound.
  bool is_free(CellId a, CellId b) const {
    return space_.is_free(point_of(a), point_of(b), query_.radius);
  }

  std::vector<Point> route_over(const Approach& out, const Approach& in, CellId last) {
    std::vector<Point> route{query_.goal};
    for (std::size_t i = 0; i < in.walked; ++i)
      route.push_back(point_of_voxel(query_.to.voxels[i]));
    for (CellId cell = last;; cell = met_[cell].from) {
      route.push_back(point_of(cell));
      if (met_[cell].from == cell) break;
    }
    for (std::size_t i = out.walked; i-- > 0;)
      route.push_back(point_of_voxel(query_.from.voxels[i]));
    route.push_back(query_.start);
    std::reverse(route.begin(), route.end());
    return route;
  }

  const EsdfMap& esdf_;
  const std::vector<CellGraph::Cell>& cells_;
  const FreeSpace& space_;
  const CellQuery& query_;
  const CellLattice lattice_;
  const int least_code_;
  const Place goal_;
  MetCells met_;
  std::priority_queue<Open> open_;
};

}  // namespace

std::vector<Point> search_cells(const Roadmap& roadmap, const FreeSpace& space,
                                const CellQuery& query) {
  if (roadmap.cells.cells.empty()) return {};
  return CellSearch(roadmap, space, query).run();
}

}  // namespace ridgeway::detail
