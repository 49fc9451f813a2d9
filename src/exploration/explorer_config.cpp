// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/name_table.hpp"
#include "common/require.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/exploration/explorer.hpp"

namespace ridgeway {

void FieldOfView::validate() const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  detail::require(horizontal > 0.0 && horizontal <= kTurn + 1e-9, "horizontal", horizontal,
                  "give radians above 0, up to a whole turn");
  detail::require(vertical > 0.0 && vertical < std::numbers::pi, "vertical", vertical,
                  "give radians above 0 and below half a turn");
  detail::require(range > 0.0 && std::isfinite(range), "range", range, "give metres above 0");
  detail::require(nearest >= 0.0 && nearest < range, "nearest", nearest,
                  "give metres from 0 up to the range");
}

namespace {

void require_share(double share_of_range) {
  detail::require(share_of_range > 0.0 && share_of_range <= 1.0, "share_of_range", share_of_range,
                  "give a share above 0, up to 1");
}

}  // namespace

FieldOfView field_of_view(const DepthSensor& sensor, double share_of_range) {
  sensor.validate();
  require_share(share_of_range);
  const PinholeCamera& camera = sensor.camera;
  const double across = std::min(camera.cx, camera.width - 1 - camera.cx) / camera.fx;
  const double down = std::min(camera.cy, camera.height - 1 - camera.cy) / camera.fy;
  return {.horizontal = 2.0 * std::atan(across),
          .vertical = 2.0 * std::atan(down),
          .nearest = sensor.min_range,
          .range = share_of_range * sensor.max_range};
}

FieldOfView field_of_view(const SpinningLidar& lidar, double share_of_range, double row_gap) {
  lidar.validate();
  require_share(share_of_range);
  detail::require(row_gap > 0.0, "row_gap", row_gap, "give metres, above 0");
  const double between_rows = lidar.vertical / (lidar.rows - 1);
  return {.horizontal = 2.0 * std::numbers::pi,
          .vertical = lidar.vertical,
          .nearest = lidar.min_range,
          .range = std::min(share_of_range * lidar.max_range, row_gap / between_rows)};
}

void ExplorerConfig::validate() const {
  motion.validate();
  view.validate();
  detail::require(std::isfinite(motion.max_yaw_rate), "max_yaw_rate", motion.max_yaw_rate,
                  "give radians a second");
  if (within.empty())
    throw InputError("within", "holds no voxel", "give a last voxel that is not before the first");
  if (strategy != ExplorationStrategy::kTour && strategy != ExplorationStrategy::kNearest)
    throw InputError("strategy", "is no enumerator of ExplorationStrategy",
                     "give kTour or kNearest");
  detail::require(least_frontier >= 1, "least_frontier", least_frontier, "give 1 or more");
  detail::require(spacing > 0.0 && std::isfinite(spacing), "spacing", spacing,
                  "give metres above 0");
  detail::require(headings >= 4 && headings <= 32, "headings", headings, "give 4 to 32");
  detail::require(persistence >= 0.0 && std::isfinite(persistence), "persistence", persistence,
                  "give seconds from 0");
  detail::require(resolved_below >= 0.0 && resolved_below < 1.0, "resolved_below", resolved_below,
                  "give a share from 0 up to 1");
  detail::require(most_rays >= 1, "most_rays", most_rays, "give 1 or more");
  detail::require(most_stops >= 1 && most_stops <= 200, "most_stops", most_stops, "give 1 to 200");
  detail::require(kept_clearance >= 0.0 && std::isfinite(kept_clearance), "kept_clearance",
                  kept_clearance, "give metres above 0, or 0 for the roadmap's smallest radius");
  detail::require(most_looks >= 1, "most_looks", most_looks, "give 1 or more");
  if (home && !home->allFinite())
    throw InputError("home", "is not finite", "give three finite coordinates");
  detail::require(until > 0.0, "until", until, "give seconds above 0");
  detail::require(period >= 0.0 && std::isfinite(period), "period", period, "give seconds from 0");
  if (std::isfinite(until) && !home)
    throw InputError("until", "is given without a home", "give a place to be then");
}

std::string_view name_of(ExplorationStatus status) {
  constexpr std::array<std::string_view, 6> kNames{"fly",      "keep",        "return",
                                                   "complete", "out_of_time", "stuck"};
  return name_in(kNames, status);
}

std::string_view name_of(UnseenReason reason) {
  constexpr std::array<std::string_view, 4> kNames{"too_narrow", "out_of_view", "looked_in_vain",
                                                   "not_visited"};
  return name_in(kNames, reason);
}

}  // namespace ridgeway
