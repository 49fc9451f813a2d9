// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "query_file.hpp"
#include "ridgeway/planning/blocked_route.hpp"

namespace ridgeway::cli {

/// The query as it was planned: from and to where its ends were moved, if they were.
Query as_planned(Query query, const PlanResult& plan);

/// A path that was given, to be flown as it is; the trajectory along it says whether it is free.
/// Throws InputError, naming `where` it came from, for one without waypoints or off the map.
PlanResult given_path(const Roadmap& roadmap, std::vector<Point> waypoints,
                      const std::string& where);

/// Which ends of a query are places on a longer way, which stay where they are.
struct OnTheWay {
  bool start = false, goal = false;
};

/// What people ask about answers, beyond what a query finds out: what a path runs beside, and why
/// there is none. What that takes of the whole map is made once, when it is first asked for.
class AnswerFacts {
 public:
  /// The roadmap must outlive it. `asked`: as the plans were asked for.
  explicit AnswerFacts(const Roadmap& roadmap, PlanConfig asked = {})
      : roadmap_(roadmap), asked_(std::move(asked)) {}

  /// From now on plans are asked for so.
  void set_asked(PlanConfig asked) {
    asked_ = std::move(asked);
    last_.reset();
  }

  // Of a query as it was planned:

  /// Why a plan has its status, and what to do about it; empty if it is ok.
  std::string reason(const Query& query, PlanStatus status, OnTheWay on_the_way = {});

  /// What blocks the way where there is no route.
  std::optional<BlockedRoute> blocked(const Query& query, PlanStatus status);

  PathSurroundings surroundings(std::span<const Point> path, double radius);

 private:
  std::string explain_no_route(const Query& query);
  std::string explain_endpoint(const Query& query, PlanStatus status, OnTheWay on_the_way);
  std::string explain_collision(const Query& query, const Point& place, bool is_movable);
  /// Whether the obstacle that is nearest to a place, within a radius, is unknown space.
  bool is_unknown_nearest(const Point& place, double radius);
  std::string robot_text(const Query& query) const;
  std::string or_snap(bool is_movable) const;

  const Roadmap& roadmap_;
  PlanConfig asked_;
  std::optional<RouteBlocks> blocks_;
  std::optional<std::pair<Query, std::optional<BlockedRoute>>> last_;  // asked of blocks_
  std::optional<Surroundings> around_;
};

nlohmann::ordered_json json_of(const BlockedRoute& blocked);

}  // namespace ridgeway::cli
