// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "flight_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/number_text.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr double kStep = 1e-3;       // seconds between samples
constexpr double kSamePlace = 1e-6;  // metres
constexpr double kTouching = 1e-7;   // metres
constexpr int kLeastSamples = 4;     // as many as a third difference takes

using Sample = Eigen::Vector4d;  // x, y, z, yaw

Sample evaluate(const TrajectorySegment& segment, double t) {
  Sample sum = Sample::Zero();
  double power = 1.0;
  for (int k = 0; k < kCoefficients; ++k, power *= t) sum += power * segment.coefficients.col(k);
  return sum;
}

/// Evenly in time from the first moment to the last, over the joints; sets the time between two.
std::vector<Sample> sample_evenly(const std::vector<TrajectorySegment>& segments, double& step) {
  double duration = 0.0;
  for (const TrajectorySegment& segment : segments) duration += segment.duration;
  const auto pieces =
      std::max<std::size_t>(kLeastSamples, static_cast<std::size_t>(std::ceil(duration / kStep)));
  step = duration / static_cast<double>(pieces);
  std::vector<Sample> samples;
  samples.reserve(pieces + 1);
  std::size_t segment = 0;
  double began = 0.0;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) * step;
    while (segment + 1 < segments.size() && t > began + segments[segment].duration)
      began += segments[segment++].duration;
    samples.push_back(
        evaluate(segments[segment], std::clamp(t - began, 0.0, segments[segment].duration)));
  }
  return samples;
}

std::string complaint_about_ends(const std::vector<TrajectorySegment>& segments, const Point& start,
                                 const Point& goal) {
  const auto end = [](const TrajectorySegment& s) { return evaluate(s, s.duration); };
  if ((evaluate(segments.front(), 0.0).head<3>() - start).norm() > kSamePlace)
    return "starts elsewhere";
  if ((end(segments.back()).head<3>() - goal).norm() > kSamePlace) return "ends elsewhere";
  for (std::size_t i = 1; i < segments.size(); ++i)
    if ((evaluate(segments[i], 0.0) - end(segments[i - 1])).norm() > kSamePlace) return "jumps";
  return {};
}

/// Largest differences. Before the start the robot goes on as it came, after the goal it rests, so
/// that a jump of velocity at either end shows as acceleration.
void measure_motion(const std::vector<Sample>& samples, double step, const Point& start_velocity,
                    FlightVerdict& verdict) {
  if (!(step > 0.0)) return;
  std::vector<Point> places{samples.front().head<3>() - step * start_velocity};
  for (const Sample& sample : samples) places.emplace_back(sample.head<3>());
  places.push_back(places.back());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample change = samples[i] - samples[i - 1];
    verdict.length += change.head<3>().norm();
    verdict.speed = std::max(verdict.speed, change.head<3>().norm() / step);
    verdict.yaw_rate = std::max(verdict.yaw_rate, std::abs(change.w()) / step);
  }
  const auto second = [&](std::size_t i) -> Point {
    return (places[i + 1] - 2.0 * places[i] + places[i - 1]) / (step * step);
  };
  for (std::size_t i = 1; i + 1 < places.size(); ++i)
    verdict.acceleration = std::max(verdict.acceleration, second(i).norm());
  for (std::size_t i = 2; i + 3 < places.size(); ++i)
    verdict.jerk = std::max(verdict.jerk, (second(i + 1) - second(i)).norm() / step);
}

std::string complaint_about_motion(const FlightVerdict& seen, const MotionLimits& limits,
                                   double step, double largest_coordinate) {
  if (!(step > 0.0)) return {};
  const double rounding =
      64.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, largest_coordinate);
  const auto exceeds = [&](double value, double limit, double smallest_change) {
    return value > limit * (1.0 + 1e-6) + smallest_change;
  };
  const auto text = [](const char* what, double value) { return what + number_text(value); };
  if (exceeds(seen.speed, limits.max_speed, rounding / step)) return text("speed ", seen.speed);
  if (exceeds(seen.acceleration, limits.max_acceleration, rounding / (step * step)))
    return text("acceleration ", seen.acceleration);
  if (exceeds(seen.jerk, limits.max_jerk, rounding / (step * step * step)))
    return text("jerk ", seen.jerk);
  if (exceeds(seen.yaw_rate, limits.max_yaw_rate, rounding / step))
    return text("yaw rate ", seen.yaw_rate);
  return {};
}

}  // namespace

FlightJudge::FlightJudge(const OccupancyMap& map, UnknownPolicy policy)
    : voxel_size_(map.voxel_size), to_own_(VoxelIndex{} - map.origin), policy_(policy) {
  if (map.layout.block_count() == 0)
    throw InputError("the map", "has no voxels", "give a map of something");
  low_ = high_ = map.layout.index_of(0);
  for (VoxelId id = 0; id < map.layout.voxel_count(); id += kBlockVoxels) {
    const VoxelIndex first = map.layout.index_of(id),
                     last = map.layout.index_of(id + kBlockVoxels - 1);
    low_ = {std::min(low_.x, first.x), std::min(low_.y, first.y), std::min(low_.z, first.z)};
    high_ = {std::max(high_.x, last.x), std::max(high_.y, last.y), std::max(high_.z, last.z)};
  }
  const auto side = [](int low, int high) { return static_cast<double>(high) - low + 1.0; };
  const double voxels = side(low_.x, high_.x) * side(low_.y, high_.y) * side(low_.z, high_.z);
  require_memory(voxels, "the box around the map", "give a smaller map");
  states_.reserve(static_cast<std::size_t>(voxels));
  for (int z = low_.z; z <= high_.z; ++z)
    for (int y = low_.y; y <= high_.y; ++y)
      for (int x = low_.x; x <= high_.x; ++x) states_.push_back(map.at({x, y, z}));
}

FlightVerdict FlightJudge::judge(const TrajectoryResult& flown, const Point& start_world,
                                 const Point& goal_world, const TrajectoryConfig& config) const {
  FlightVerdict verdict;
  const Point start = moved(start_world, to_own_, voxel_size_),
              goal = moved(goal_world, to_own_, voxel_size_);
  std::vector<TrajectorySegment> segments = flown.trajectory.segments;
  for (TrajectorySegment& segment : segments) {
    const Point begin = segment.coefficients.col(0).head<3>();
    segment.coefficients.col(0).head<3>() = moved(begin, to_own_, voxel_size_);
  }
  if (segments.empty()) {
    verdict.complaint = "no segments";
    return verdict;
  }
  double step = 0.0;
  const std::vector<Sample> samples = sample_evenly(segments, step);
  double largest_coordinate = 0.0;
  for (const Sample& sample : samples) {
    if (!sample.allFinite()) {
      verdict.complaint = "is not finite";
      return verdict;
    }
    largest_coordinate = std::max(largest_coordinate, sample.cwiseAbs().maxCoeff());
  }
  measure_motion(samples, step, config.start_velocity, verdict);
  verdict.complaint = complaint_about_ends(segments, start, goal);
  if (verdict.holds())
    verdict.complaint = complaint_about_motion(verdict, config.motion, step, largest_coordinate);
  look_around(samples, config.radius, verdict);
  if (verdict.holds() && verdict.clearance < config.radius + 0.5 * voxel_size_ &&
      verdict.clearance < flown.clearance - 1e-9)
    verdict.complaint = "states a larger clearance than " + number_text(verdict.clearance);
  return verdict;
}

/// The smallest distance of all samples. A place as far as d, moved by less than what d exceeds the
/// smallest by, cannot undercut it, so that it needs no look.
void FlightJudge::look_around(const std::vector<Sample>& samples, double radius,
                              FlightVerdict& verdict) const {
  verdict.clearance = radius + 0.5 * voxel_size_;
  double safe_for = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Point p = samples[i].head<3>();
    if (policy_ == UnknownPolicy::kIgnore && verdict.holds() && !touches_free(p))
      verdict.complaint = "leaves the known";
    if (i > 0) safe_for -= (samples[i] - samples[i - 1]).head<3>().norm();
    if (safe_for > 0.0) continue;
    const double d = distance(p, radius + voxel_size_);
    verdict.clearance = std::min(verdict.clearance, d);
    safe_for = d - verdict.clearance;
  }
  if (verdict.holds() && verdict.clearance < radius - kTouching)
    verdict.complaint = "collides at " + number_text(verdict.clearance);
}

VoxelState FlightJudge::at(int x, int y, int z) const {
  if (x < low_.x || y < low_.y || z < low_.z || x > high_.x || y > high_.y || z > high_.z)
    return VoxelState::kUnknown;
  const auto nx = static_cast<std::size_t>(high_.x - low_.x + 1);
  const auto ny = static_cast<std::size_t>(high_.y - low_.y + 1);
  return states_[(static_cast<std::size_t>(z - low_.z) * ny +
                  static_cast<std::size_t>(y - low_.y)) *
                     nx +
                 static_cast<std::size_t>(x - low_.x)];
}

/// Whether a place lies in, or on the border of, a voxel that is known to be free.
bool FlightJudge::touches_free(const Point& p) const {
  const auto low = [&](double v) { return static_cast<int>(std::floor(v / voxel_size_ - 1e-6)); };
  const auto high = [&](double v) { return static_cast<int>(std::floor(v / voxel_size_ + 1e-6)); };
  for (int z = low(p.z()); z <= high(p.z()); ++z)
    for (int y = low(p.y()); y <= high(p.y()); ++y)
      for (int x = low(p.x()); x <= high(p.x()); ++x)
        if (at(x, y, z) == VoxelState::kFree) return true;
  return false;
}

/// To the nearest cube of a voxel that is an obstacle; `reach` where none is nearer.
double FlightJudge::distance(const Point& p, double reach) const {
  const double s = voxel_size_;
  double best = reach * reach;
  const auto low = [&](double v) { return static_cast<int>(std::floor((v - reach) / s)); };
  const auto high = [&](double v) { return static_cast<int>(std::floor((v + reach) / s)); };
  const auto off = [&](int i, double v) { return std::max({i * s - v, v - (i + 1) * s, 0.0}); };
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

}  // namespace ridgeway
