// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "answering.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "common/clock.hpp"
#include "common/rounding.hpp"
#include "paths/planning_constants.hpp"
#include "paths/shorten.hpp"
#include "query.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "roadmap/cell_guide.hpp"
#include "roadmap/cell_search.hpp"
#include "roadmap/open_parts.hpp"
#include "route.hpp"
#include "short_path.hpp"
#include "tangent_path.hpp"

namespace ridgeway::detail {
namespace {

/// A query that is being answered.
class Answering {
 public:
  Answering(const Roadmap& roadmap, const FreeSpace& space, const Point& start, const Point& goal,
            double radius, const PlanConfig& config, const Deadline& deadline)
      : roadmap_(roadmap),
        esdf_(roadmap.esdf),
        space_(space),
        config_(config),
        deadline_(deadline),
        query_{kNoVoxel, kNoVoxel, start, goal, radius, config.prefer_clearance} {
    result_.unknown = esdf_.unknown;
  }

  PlanResult run() {
    const double began = seconds_now();
    result_.status = find_path();
    if (!result_.ok()) result_.waypoints.clear();
    result_.seconds.total = seconds_now() - began;
    return std::move(result_);
  }

 private:
  bool is_quick() const { return config_.quick && config_.within == 0.0; }
  /// Lengths over the expected one that are good enough to ask nothing else.
  double near() const { return is_quick() ? kPlanning.far : kPlanning.near; }
  bool wants_short() const { return config_.shorten && config_.prefer_clearance == 0.0; }

  /// Takes a path for the answer if it holds.
  bool accept(Route path, const KnownStretch& known) {
    result_.waypoints = std::move(path);
    describe(space_, known, result_);
    if (!is_verified(esdf_, space_, result_, query_.radius)) return false;
    drop_repeated(result_.waypoints);
    return true;
  }

  PlanStatus find_path() {
    const auto& [from, to, start, goal, radius, prefer_clearance] = query_;
    if (!is_as_wide(space_.inner_radius(radius), roadmap_.min_clearance))
      return PlanStatus::kRadiusTooSmall;
    const QueryEnds ends = find_ends(space_, start, goal, radius);
    if (ends.status != PlanStatus::kOk) return straight_or(ends.status);
    query_.from = ends.from;
    query_.to = ends.to;
    result_.answered_by = config_.planner;
    if ((wants_short() || start == goal) && space_.is_free(start, goal, radius))
      return accept({start, goal}, {}) ? PlanStatus::kOk : PlanStatus::kNoRoute;

    if (config_.shorten && prefer_clearance > 0.0) return search_for_cheapest();
    TangentPath tangents = path_over_corners();
    if (wants_short() && !tangents.waypoints.empty() && is_enough(tangents) &&
        accept(tangents.waypoints, tangents.known))
      return PlanStatus::kOk;
    return search(std::move(tangents.waypoints));
  }

  PlanStatus straight_or(PlanStatus refused) {
    const auto& [from, to, start, goal, radius, prefer_clearance] = query_;
    if (!may_go_straight(refused, space_, start, goal, radius) || !accept({start, goal}, {}))
      return refused;
    result_.answered_by = config_.planner;
    return PlanStatus::kOk;
  }

  TangentPath path_over_corners() {
    if (!config_.shorten || config_.planner != Planner::kGraph || !space_.is_for_sphere())
      return {};
    TangentPath tangents = plan_tangents(roadmap_.tangents, space_, query_, is_quick(), deadline_);
    result_.seconds.search = tangents.search_seconds;
    result_.seconds.shorten = tangents.shorten_seconds;
    if (!space_.is_within_limits(tangents.waypoints)) return {};
    return tangents;
  }

  /// The ways of both ends to the graph.
  const Attachment& attachment() {
    if (!attachment_) attachment_ = attach(roadmap_, space_, query_);
    return *attachment_;
  }

  /// Whether they show that moves between voxels lead from end to end.
  bool is_connected() {
    // Mostly there is no need to follow them to their ends: both come to the same open part of
    // space.
    if (!attachment_ && is_as_wide(roadmap_.min_clearance, query_.radius))
      if (const std::uint32_t part = open_part_of(roadmap_, query_.from);
          part != CellGraph::kNotOpen && part == open_part_of(roadmap_, query_.to))
        return true;
    return attachment().reach == Reach::kConnected || attachment().reach == Reach::kJoined;
  }

  bool is_enough(const TangentPath& tangents) const {
    if (config_.within > 0.0) return excess(tangents.waypoints) <= config_.within;
    return over_expected(tangents.waypoints) <= near();
  }

  /// How many times the bound a path is long; infinite for none.
  double excess(const Route& path) const {
    return path.empty() ? std::numeric_limits<double>::infinity() : length_over_bound(path);
  }

  /// How many times a path is as long as one may be expected to be; infinite for none.
  double over_expected(const Route& path) const {
    if (path.empty()) return std::numeric_limits<double>::infinity();
    const double straight = (query_.goal - query_.start).norm();
    const double expected = length_between(roadmap_, query_.from, query_.to, query_.radius);
    return length_of(path) / std::max(straight, expected);
  }

  PlanStatus search(Route known) {
    Lap lap;
    const bool is_over_graph = config_.planner == Planner::kGraph;
    if (!is_over_graph && config_.planner != Planner::kDiagram)
      attachment_.emplace();  // find_route needs none
    if (wants_short() && is_over_graph && !space_.is_narrowed() && is_connected()) {
      result_.seconds.attach += lap.seconds();
      look_over_cells(known);
      known = improve(std::move(known));
      search_over_voxels(known, 0);
      result_.seconds.shorten += lap.seconds();
      if (is_plausible(known) && accept(known, {})) return PlanStatus::kOk;
    }
    attachment();
    result_.seconds.attach += lap.seconds();
    RouteResult found =
        find_route(roadmap_, space_, query_, attachment(), config_.planner, deadline_);
    result_.seconds.search += lap.seconds();
    result_.answered_by = found.answered_by;
    if (found.status == SearchStatus::kTimeout && known.empty()) return PlanStatus::kTimeout;
    if (found.status == SearchStatus::kNoRoute) {
      // The lattice knows no way, but corners or a straight look may slip through what it cannot
      // resolve.
      result_.answered_by = config_.planner;
      if (wants_short() && !known.empty() && accept(known, {})) return PlanStatus::kOk;
      return space_.is_free(query_.start, query_.goal, query_.radius) &&
                     accept({query_.start, query_.goal}, {})
                 ? PlanStatus::kOk
                 : PlanStatus::kNoRoute;
    }
    if (wants_short() && accept(tightened(found.route, known), {})) {
      result_.seconds.shorten += lap.seconds();
      return PlanStatus::kOk;
    }
    if (found.status == SearchStatus::kTimeout) return PlanStatus::kTimeout;
    // What the search found holds move by move, whatever became of it since.
    return accept(std::move(found.route), found.known) ? PlanStatus::kOk : PlanStatus::kNoRoute;
  }

  /// Makes what is known shorter by way of the cells, as far as they have something shorter.
  void look_over_cells(Route& known) {
    if (over_expected(known) <= near()) return;
    const double longest = known.empty() ? 0.0 : length_of(known);
    CellRoute cells;
    const auto search = [&](const AttachWay& from, const AttachWay& to) {
      cells = path_over_cells(roadmap_, space_, query_, from, to, longest, deadline_);
    };
    // Most ends see cells that are connected: then how they go on into the graph is not needed.
    if (!attachment_) search({.voxels = {query_.from}}, {.voxels = {query_.to}});
    if (!cells.is_direct) search(attachment().from, attachment().to);
    known = shorter(known, cells.waypoints);
  }

  bool is_plausible(const Route& path) const {
    if (path.empty()) return false;
    if (config_.within > 0.0) return excess(path) <= config_.within;
    return is_quick() || over_expected(path) <= kPlanning.far;
  }

  /// The same by way of voxels, where places of cells are too coarse; each effort once, the second
  /// where the first found no way. Over short distances without a guide: in clutter guides mislead.
  void search_over_voxels(Route& known, std::size_t effort) {
    const GuidedEffort& guided = kPlanning.guided[effort];
    const double enough = effort == 0 ? kPlanning.doubtful : kPlanning.far;
    if (is_quick() || efforts_over_voxels_ != effort || over_expected(known) <= enough ||
        deadline_.has_passed())
      return;
    ++efforts_over_voxels_;
    const double reach = kPlanning.voxel_reach * esdf_.voxel_size;
    const bool is_short = (query_.goal - query_.start).norm() <= reach;
    bool found = effort == 0 && is_short && search_over_voxels(known, nullptr, kPlanning.unguided);
    if (!found) {
      CellGuide guide(roadmap_, space_, query_.radius, query_.from, query_.to);
      found = guide.find_way(guided.most_parts, deadline_) &&
              search_over_voxels(known, &guide, guided.most_voxels);
    }
    if (found) efforts_over_voxels_ = kPlanning.guided.size();
  }
  bool search_over_voxels(Route& known, const CellGuide* guide, int most_voxels) {
    const double longest =
        known.empty() ? std::numeric_limits<double>::infinity() : length_of(known);
    const Route path =
        path_over_voxels(roadmap_, space_, query_, longest, guide, most_voxels, deadline_);
    if (path.empty()) return false;
    known = improve(shorter(known, path));
    return true;
  }

  Route shorter(const Route& a, const Route& b) const { return excess(b) < excess(a) ? b : a; }

  Route improve(Route path) const {
    if (path.empty() || over_expected(path) <= near()) return path;
    return past_what_blocks(esdf_, space_, query_, std::move(path), deadline_);
  }

  Route tightened(const Route& found, const Route& known) {
    const double shortest =
        known.empty() ? std::numeric_limits<double>::infinity() : length_of(known);
    Route path = improve(shorten_below(space_, found, query_.radius, shortest, deadline_));
    path = shorter(known, path);
    search_over_voxels(path, 0);
    search_over_voxels(path, 1);
    if (config_.within > 0.0 && excess(path) > config_.within && !deadline_.has_passed())
      path = shorter(path, improve(shortest_over_voxels(esdf_, space_, query_, deadline_)));
    return path;
  }

  /// The short path first, then what costs less: the routes that are cheapest and shortest as they
  /// are found.
  PlanStatus search_for_cheapest() {
    PlanConfig short_config = config_;
    short_config.prefer_clearance = 0.0;
    PlanResult short_path = Answering(roadmap_, space_, query_.start, query_.goal, query_.radius,
                                      short_config, deadline_)
                                .run();
    if (!short_path.ok()) return short_path.status;
    Lap lap;
    PlanSeconds seconds = short_path.seconds;
    attachment();
    seconds.attach += lap.seconds();
    std::vector<Route> routes;
    std::vector<Planner> answered_by;
    for (const double preference : {query_.prefer_clearance, 0.0}) {
      RouteQuery query = query_;
      query.prefer_clearance = preference;
      RouteResult found =
          find_route(roadmap_, space_, query, attachment(), config_.planner, deadline_);
      if (found.route.empty()) continue;
      answered_by.push_back(found.answered_by);
      routes.push_back(std::move(found.route));
    }
    seconds.search += lap.seconds();
    CheapestRoute best =
        cheapest(space_, query_, std::move(routes), short_path.waypoints, deadline_);
    if (best.found && accept(std::move(best.route), {}))
      result_.answered_by = answered_by[*best.found];
    else
      result_ = std::move(short_path);
    seconds.shorten += lap.seconds();
    result_.seconds = seconds;
    return PlanStatus::kOk;
  }

  const Roadmap& roadmap_;
  const EsdfMap& esdf_;
  const FreeSpace& space_;
  const PlanConfig& config_;
  const Deadline& deadline_;
  RouteQuery query_;
  std::size_t efforts_over_voxels_ = 0;  // that were made, or need not be
  std::optional<Attachment> attachment_;
  PlanResult result_;
};

}  // namespace

PlanResult plan_between(const Roadmap& roadmap, const FreeSpace& space, const Point& start,
                        const Point& goal, double radius, const PlanConfig& config,
                        const Deadline& deadline) {
  return Answering(roadmap, space, start, goal, radius, config, deadline).run();
}

}  // namespace ridgeway::detail
