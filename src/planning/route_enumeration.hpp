// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <vector>

#include "paths/deadline.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "route.hpp"

namespace ridgeway::detail {

/// Routes from start to goal within the limits that pass no vertex of the graph twice, by
/// increasing length. Start and goal are joined to the vertices that the attach field leads to, and
/// to those that they see and do not see past another.
///
/// A route to a fork is followed no further where it deforms into a shorter one over some of the
/// same vertices: whatever goes on from it goes on from the other.
class RouteEnumeration {
 public:
  RouteEnumeration(const Roadmap& roadmap, const FreeSpace& space, const RouteQuery& query,
                   const Deadline& deadline);

  /// Nothing when there are no more, or too many were looked at; see `complete`.
  std::optional<Route> next();
  bool complete() const { return open_.empty() && !is_cut_short_; }
  /// Whether time is up: what came last may not be what it would have been.
  bool time_is_up();

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// One vertex of a route; `from` is the piece before it.
  struct Piece {
    VertexId vertex = kNoVertex;  ///< kNoVertex: the goal
    std::uint32_t from = kNone;
    double length = 0.0;
  };
  struct OpenEntry {
    double estimate;
    std::uint32_t piece;
    bool operator<(const OpenEntry& other) const {  // the queue's top is the best
      return estimate != other.estimate ? estimate > other.estimate : piece > other.piece;
    }
  };
  /// A route to a fork.
  struct Followed {
    Route route;
    std::vector<VertexId> vertices;  ///< sorted
  };
  using Legs = std::map<VertexId, Route>;  ///< from an end of the query to a vertex

  Legs legs_from(const Point& end, VoxelId voxel);
  bool is_wide_enough(const Link& link) const;
  bool may_be_taken(VertexId from, const Link& link) const;
  /// As limits that the graph was not made for move it.
  Point place_of(VertexId v) const;
  bool is_free(const Route& route) const;
  void push(Piece piece, double rest);
  void expand(std::uint32_t piece);
  std::vector<VertexId> vertices_to(std::uint32_t piece) const;
  Route route_to(std::uint32_t piece) const;
  bool is_redundant(std::uint32_t piece);

  const Roadmap& roadmap_;
  const FreeSpace space_;
  const RouteQuery query_;
  const Deadline deadline_;
  bool is_cut_short_ = false;
  Legs starts_, goals_;
  std::vector<double> rest_;  ///< length from each vertex to the goal
  std::vector<Piece> pieces_;
  std::priority_queue<OpenEntry> open_;
  std::map<VertexId, std::vector<Followed>> followed_;  ///< by the fork
  std::size_t expansions_ = 0;
};

}  // namespace ridgeway::detail
