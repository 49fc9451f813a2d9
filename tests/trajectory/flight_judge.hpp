// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ridgeway/esdf/esdf_map.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway::testing {

/// An independent judge of trajectories: evaluates the polynomials itself, every millisecond, and
/// looks at every voxel near enough to matter, in a plain dense grid of its own.
class FlightJudge {
 public:
  FlightJudge(const OccupancyMap& map, UnknownPolicy policy) : s_(map.voxel_size), policy_(policy) {
    low_ = high_ = map.layout.index_of(0);
    for (VoxelId id = 0; id < map.layout.voxel_count(); id += kBlockVoxels) {
      const VoxelIndex first = map.layout.index_of(id);
      low_ = {std::min(low_.x, first.x), std::min(low_.y, first.y), std::min(low_.z, first.z)};
      high_ = {std::max(high_.x, first.x + 7), std::max(high_.y, first.y + 7),
               std::max(high_.z, first.z + 7)};
    }
    for (int z = low_.z; z <= high_.z; ++z)
      for (int y = low_.y; y <= high_.y; ++y)
        for (int x = low_.x; x <= high_.x; ++x) states_.push_back(map.at({x, y, z}));
  }

  /// What is wrong with a trajectory along a path, if anything.
  std::optional<std::string> complaint(const TrajectoryResult& result, const Point& start,
                                       const Point& goal, const TrajectoryConfig& config) const {
    const auto& segments = result.trajectory.segments;
    if (segments.empty()) return "no segments";
    const Point end = evaluate(segments.back(), segments.back().duration).head<3>();
    if ((evaluate(segments.front(), 0.0).head<3>() - start).norm() > 1e-6)
      return "starts elsewhere";
    if ((end - goal).norm() > 1e-6) return "ends elsewhere";
    double clearance = 1e9, free_for = 0.0;
    Eigen::Vector4d before = evaluate(segments.front(), 0.0), before_that = before;
    Eigen::Vector4d last_end = before;
    for (const TrajectorySegment& segment : segments) {
      if ((evaluate(segment, 0.0) - last_end).norm() > 1e-6) return "jumps";
      const int n = std::max(1, static_cast<int>(std::ceil(segment.duration / kStep)));
      const double dt = segment.duration / n;
      int count = 0;
      for (int k = 0; k <= n && dt > 0.0; ++k, ++count) {
        const Eigen::Vector4d now = evaluate(segment, k * dt);
        const Eigen::Vector4d step = now - before;
        if (count > 0) {
          const double speed = step.head<3>().norm() / dt;
          if (speed > config.limits.max_speed * (1 + 1e-6)) return "too fast";
          if (std::abs(step.w()) / dt > config.limits.max_yaw_rate * (1 + 1e-6)) return "turns";
          free_for -= step.head<3>().norm();
        }
        if (count > 1 && dt > 1e-4) {
          const double a = (step - (before - before_that)).head<3>().norm() / (dt * dt);
          if (a > config.limits.max_acceleration * (1 + 1e-5) + 1e-6) return "accelerates";
        }
        before_that = before;
        before = now;
        // A distance tells of all places within what it exceeds the radius by.
        if (free_for > 1e-3 && count > 0) continue;
        const Point p = now.head<3>();
        if (policy_ == UnknownPolicy::kIgnore && !touches_free(p)) return "leaves the known";
        const double d = distance(p, config.radius + s_);
        if (d < config.radius - 1e-7) return "collides at " + std::to_string(d);
        clearance = std::min(clearance, d);
        free_for = policy_ == UnknownPolicy::kIgnore ? 0.0 : d - config.radius;
      }
      last_end = evaluate(segment, segment.duration);
    }
    if (clearance < result.clearance - 1e-9 && result.clearance < config.radius + s_)
      return "states a larger clearance";
    return std::nullopt;
  }

 private:
  static constexpr double kStep = 1e-3;  // seconds

  static Eigen::Vector4d evaluate(const TrajectorySegment& segment, double t) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    double power = 1.0;
    for (int k = 0; k < kCoefficients; ++k, power *= t) sum += power * segment.coefficients.col(k);
    return sum;
  }

  VoxelState at(int x, int y, int z) const {
    if (x < low_.x || y < low_.y || z < low_.z || x > high_.x || y > high_.y || z > high_.z)
      return VoxelState::kUnknown;
    const auto nx = high_.x - low_.x + 1, ny = high_.y - low_.y + 1;
    return states_[static_cast<std::size_t>(((z - low_.z) * ny + y - low_.y) * nx + x - low_.x)];
  }

  bool touches_free(const Point& p) const {
    const auto low = [&](double v) { return static_cast<int>(std::floor(v / s_ - 1e-6)); };
    const auto high = [&](double v) { return static_cast<int>(std::floor(v / s_ + 1e-6)); };
    for (int z = low(p.z()); z <= high(p.z()); ++z)
      for (int y = low(p.y()); y <= high(p.y()); ++y)
        for (int x = low(p.x()); x <= high(p.x()); ++x)
          if (at(x, y, z) == VoxelState::kFree) return true;
    return false;
  }

  double distance(const Point& p, double reach) const {
    double best = reach * reach;
    const auto low = [&](double v) { return static_cast<int>(std::floor((v - reach) / s_)); };
    const auto high = [&](double v) { return static_cast<int>(std::floor((v + reach) / s_)); };
    const auto off = [&](int i, double v) { return std::max({i * s_ - v, v - (i + 1) * s_, 0.0}); };
    for (int z = low(p.z()); z <= high(p.z()); ++z)
      for (int y = low(p.y()); y <= high(p.y()); ++y) {
        const double dy = off(y, p.y()), dz = off(z, p.z()), beside = dy * dy + dz * dz;
        if (beside >= best) continue;
        for (int x = low(p.x()); x <= high(p.x()); ++x) {
          const VoxelState state = at(x, y, z);
          if (state == VoxelState::kOccupied ||
              (state == VoxelState::kUnknown && policy_ == UnknownPolicy::kObstacle))
            best = std::min(best, beside + off(x, p.x()) * off(x, p.x()));
        }
      }
    return std::sqrt(best);
  }

  double s_;
  UnknownPolicy policy_;
  VoxelIndex low_, high_;
  std::vector<VoxelState> states_;
};

}  // namespace ridgeway::testing
