// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <optional>

#include "bernstein.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/trajectory/plan_trajectory.hpp"

namespace ridgeway {
namespace {

using detail::BezierPoints;

constexpr int kDeepest = 40;
constexpr double kShortest = 1e-3;  // voxels: a curve so short that it is given up
constexpr double kStraight = 1e-9;  // voxels: a departure that is rounding alone
constexpr double kClose = 0.1;      // voxels: a departure so small that the exact look pays

Point first_of(const BezierPoints& curve) { return curve.col(0); }
Point last_of(const BezierPoints& curve) { return curve.col(curve.cols() - 1); }

/// Largest distance from the chord of the curve's hull, and so of the curve.
double departure(const BezierPoints& curve) {
  const Point a = first_of(curve), along = last_of(curve) - a;
  const double squared = along.squaredNorm();
  double largest = 0.0;
  for (Eigen::Index i = 1; i + 1 < curve.cols(); ++i) {
    const Point p = curve.col(i) - a;
    const double t = squared > 0.0 ? std::clamp(p.dot(along) / squared, 0.0, 1.0) : 0.0;
    largest = std::max(largest, (p - t * along).squaredNorm());
  }
  return std::sqrt(largest);
}

class Verifier {
 public:
  Verifier(const FreeSpace& space, double radius)
      : space_(space), esdf_(space.map()), radius_(radius) {}

  /// Share of the curve at which doubt begins.
  std::optional<double> first_doubt(const BezierPoints& curve, double begin = 0.0,
                                    double length = 1.0, int depth = 0) const {
    if (is_shown_free(curve)) return std::nullopt;
    const Point middle_of_box = 0.5 * (curve.rowwise().minCoeff() + curve.rowwise().maxCoeff());
    const double reach = (curve.colwise() - middle_of_box).colwise().norm().maxCoeff();
    if (depth == kDeepest || reach < kShortest * esdf_.voxel_size) return begin;
    BezierPoints left, right;
    detail::halve(curve, left, right);
    if (!space_.is_free(first_of(curve), radius_)) return begin;
    const double half = 0.5 * length;
    if (const auto doubt = first_doubt(left, begin, half, depth + 1)) return doubt;
    return first_doubt(right, begin + half, half, depth + 1);
  }

 private:
  bool is_shown_free(const BezierPoints& curve) const {
    const double off = departure(curve), s = esdf_.voxel_size;
    const Point a = first_of(curve), b = last_of(curve);
    if (!space_.is_within_limits(curve, a, b, off)) return false;
    const bool free = off > kClose * s ? space_.is_clearly_free(a, b, radius_ + off)
                                       : space_.is_free(a, b, radius_ + off);
    return free && (esdf_.unknown == UnknownPolicy::kObstacle || off <= kStraight * s ||
                    box_is_known_free(curve));
  }

  bool box_is_known_free(const BezierPoints& curve) const {
    const VoxelIndex low = voxel_at(Point(curve.rowwise().minCoeff()), esdf_.voxel_size);
    const VoxelIndex high = voxel_at(Point(curve.rowwise().maxCoeff()), esdf_.voxel_size);
    constexpr int kWidest = 16;  // voxels: a larger box is halved at less cost
    if (std::max({high.x - low.x, high.y - low.y, high.z - low.z}) > kWidest) return false;
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const VoxelId id = esdf_.layout.find({x, y, z});
          if (!esdf_.is_open(id)) return false;
        }
    return true;
  }

  const FreeSpace space_;
  const EsdfMap& esdf_;
  double radius_;
};

/// Points of a curve such that it departs from the chords between them by at most `most`, and by
/// how much.
double flatten(const BezierPoints& curve, double most, int depth, std::vector<Point>& points) {
  const double off = departure(curve);
  if (off <= most || depth == kDeepest) {
    points.push_back(last_of(curve));
    return off;
  }
  BezierPoints left, right;
  detail::halve(curve, left, right);
  const double before = flatten(left, most, depth + 1, points);
  return std::max(before, flatten(right, most, depth + 1, points));
}

}  // namespace

std::vector<double> find_doubts(const FreeSpace& space, const Trajectory& trajectory,
                                double radius) {
  const EsdfMap& esdf = space.map();
  const Verifier verifier(space, radius);
  std::vector<double> doubts;
  double begin = 0.0;
  for (const TrajectorySegment& segment : trajectory.segments) {
    const BezierPoints curve = detail::bezier_points(segment, 0, 0, 3);
    const bool has_voxels = has_voxel(curve.rowwise().minCoeff(), esdf.voxel_size) &&
                            has_voxel(curve.rowwise().maxCoeff(), esdf.voxel_size);
    const std::optional<double> share = has_voxels ? verifier.first_doubt(curve) : 0.0;
    if (share) doubts.push_back(begin + *share * segment.duration);
    begin += segment.duration;
  }
  return doubts;
}

double clearance_of(const EsdfMap& esdf, const Trajectory& trajectory) {
  constexpr double kMost = 1e-4;  // metres by which it may be told too small
  double off = 0.0;
  std::vector<Point> points;
  for (const TrajectorySegment& segment : trajectory.segments) {
    const BezierPoints curve = detail::bezier_points(segment, 0, 0, 3);
    if (points.empty()) points.push_back(first_of(curve));
    off = std::max(off, flatten(curve, kMost, 0, points));
  }
  return std::max(FreeSpace(esdf).clearance(points) - off, 0.0);
}

}  // namespace ridgeway
