// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "obstacle_scan.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Squared radius, voxel units, that a squared distance has to reach.
double squared_limit(double radius, double voxel_size) {
  return 0.25 * squared_threshold(radius, voxel_size);
}

VoxelIndex voxel_holding(const Vector& p) { return voxel_at(p, 1.0); }

/// Squared distance (voxel units) that a voxel's stored value stands for; a voxel without a site
/// is at least `far` from everything.
double stored(const EsdfMap& esdf, VoxelId id, double far) {
  return esdf.squared[id] == kNoSite ? far : 0.25 * esdf.squared[id];
}

double squared_far(const EsdfMap& esdf) {
  const double far =
      std::min(esdf.max_distance / esdf.voxel_size, static_cast<double>(kFarthestSite));
  return far * far;
}

/// Lower bound of D^2 at a point from the eight voxel centres around it: trilinear interpolation
/// of d^2 less the sum of t (1 - t), since D^2(x) - |x|^2 is concave.
double lower_bound(const EsdfMap& esdf, VoxelFinder& finder, const Vector& p, double far) {
  const Vector shifted = p - Vector::Constant(0.5);
  const VoxelIndex base = voxel_holding(shifted);
  const Vector t = shifted - Vector(base.x, base.y, base.z);
  const VoxelId corner = finder.find(base);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
    const double weight =
        (dx ? t.x() : 1.0 - t.x()) * (dy ? t.y() : 1.0 - t.y()) * (dz ? t.z() : 1.0 - t.z());
    if (weight == 0.0) continue;
    const VoxelId id = corner != kNoVoxel ? esdf.layout.step(corner, dx, dy, dz)
                                          : esdf.layout.find(base + VoxelIndex{dx, dy, dz});
    if (id == kNoVoxel) {
      if (esdf.unknown == UnknownPolicy::kIgnore) return 0.0;  // nothing is known of that corner
      continue;
    }
    sum += weight * stored(esdf, id, far);
  }
  return sum - (t.array() * (1.0 - t.array())).sum();
}

/// A minimiser of D^2 along a segment, in voxel units. March with the ball that each voxel's
/// distance guarantees; where balls get small, look closer, at last at the obstacles themselves.
class SegmentMarch {
 public:
  SegmentMarch(const EsdfMap& esdf, const Vector& a, const Vector& b)
      : esdf_(esdf), finder_(esdf.layout), a_(a), length_((b - a).norm()), far_(squared_far(esdf)) {
    along_ = length_ > 0.0 ? Vector((b - a) / length_) : Vector::Zero();
  }

  /// Whether D^2 >= limit on all of the segment.
  bool stays_above(double limit) { return first_doubt<true>(limit) > length_; }
  bool stays_clearly_above(double limit) { return first_doubt<false>(limit) > length_; }

  /// Where, in voxels from the start, a stretch of at most a voxel begins on which D^2 falls below
  /// the limit; beyond the length if there is none. Unless `exact`, also where it might.
  template <bool exact>
  double first_doubt(double limit) {
    const double radius = std::sqrt(limit);
    for (double t = 0.0; t <= length_;) {
      const double step = safe_step(at(t), radius);
      if (step < 0.0) return t;
      if (step > 0.0) {
        t += step;
        continue;
      }
      const double end = std::min(t + kCloseStep, length_);
      if (!close_stays_above<exact>(t, end, limit)) return t;
      if (end >= length_) break;
      t = end;
    }
    return kInfinity;
  }

  /// Upper bound of min D^2, from the sites of the voxels on the way; infinite where none has one.
  double upper_bound() {
    double best = std::min(at_site(at(0.0)), at_site(at(length_)));
    for (double t = 4.0; t < length_; t += 8.0) best = std::min(best, at_site(at(t)));
    return best;
  }

  /// min D^2 along the segment, if below `best` (finite), else `best`.
  double minimum(double best) {
    for (double t = 0.0; t <= length_ && best > 0.0;) {
      const double step = safe_step(at(t), std::sqrt(best));
      if (step > 0.0) {
        t += step;
        continue;
      }
      const double end = std::min(t + kCloseStep, length_);
      if (bound_between(t, end) < best)
        best = detail::ObstacleScan(esdf_, at(t), at(end)).run(best);
      if (end >= length_) break;
      t = end;
    }
    return best;
  }

 private:
  static constexpr double kCloseStep = 1.0;     // voxels looked at closely at a time
  static constexpr double kSmallestStep = 0.5;  // a ball's step below this is not worth it

  Vector at(double t) const { return a_ + t * along_; }

  /// How far one may go from x while D >= radius is certain: > 0; 0: not known; < 0: blocked.
  double safe_step(const Vector& x, double radius) {
    const VoxelIndex voxel = voxel_holding(x);
    const VoxelId id = finder_.find(voxel);
    if (id == kNoVoxel) return esdf_.unknown == UnknownPolicy::kObstacle ? -1.0 : 0.0;
    const double squared = stored(esdf_, id, far_);
    if (squared == 0.0) return -1.0;
    const double off = (x - Vector(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5)).norm();
    const double step = std::sqrt(squared) - off - radius;
    return step >= kSmallestStep ? step : 0.0;
  }

  /// Squared distance from x to the site of its voxel: never too small.
  double at_site(const Vector& x) {
    const VoxelIndex voxel = voxel_holding(x);
    const VoxelId id = finder_.find(voxel);
    if (id == kNoVoxel) return esdf_.unknown == UnknownPolicy::kObstacle ? 0.0 : kInfinity;
    if (esdf_.squared[id] == kNoSite) return kInfinity;
    const SiteOffset& o = esdf_.site[id];
    return detail::squared_distance(x, detail::cube_of(voxel + VoxelIndex{o.x, o.y, o.z}));
  }

  /// Lower bound of D^2 between two places on the segment, by concavity from bounds at the ends.
  double bound_between(double t0, double t1) {
    const double b0 = lower_bound(esdf_, finder_, at(t0), far_),
                 b1 = lower_bound(esdf_, finder_, at(t1), far_);
    const double squared = (t1 - t0) * (t1 - t0), rise = std::abs(b1 - b0);
    if (rise >= squared) return std::min(b0, b1);
    return 0.5 * (b0 + b1) - 0.25 * squared - (squared > 0.0 ? 0.25 * rise * rise / squared : 0.0);
  }

  template <bool exact>
  bool close_stays_above(double t0, double t1, double limit) {
    if (!exact) return bound_between(t0, t1) >= limit;
    if (at_site(at(t0)) < limit || at_site(at(t1)) < limit) return false;
    if (bound_between(t0, t1) >= limit) return true;
    return detail::ObstacleScan(esdf_, at(t0), at(t1)).run(limit) >= limit;
  }

  const EsdfMap& esdf_;
  VoxelFinder finder_;
  const Vector a_;
  const double length_;
  const double far_;
  Vector along_;
};

/// Whether a point lies in, or on the border of, a known-free voxel.
bool touches_free(const EsdfMap& esdf, const Vector& p) {
  constexpr double kSlack = 1e-9;
  const VoxelIndex low = voxel_holding(p - Vector::Constant(kSlack));
  const VoxelIndex high = voxel_holding(p + Vector::Constant(kSlack));
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const VoxelId id = esdf.layout.find({x, y, z});
        if (id != kNoVoxel && esdf.state[id] == VoxelState::kFree) return true;
      }
  return false;
}

}  // namespace

double FreeSpace::distance(const Point& p) const { return clearance(p, p); }

double FreeSpace::clearance(const Point& a, const Point& b) const {
  const std::array<Point, 2> path{a, b};
  return clearance(path);
}

double FreeSpace::clearance(std::span<const Point> path, double at_most) const {
  const double s = esdf_.voxel_size;
  const auto for_each_segment = [&](const auto& body) {
    for (std::size_t i = path.size() == 1 ? 0 : 1; i < path.size(); ++i)
      body(SegmentMarch(esdf_, path[i == 0 ? 0 : i - 1] / s, path[i] / s));
  };
  // A good bound first: then only the narrowest places are looked at closely.
  double best = at_most / s * (at_most / s);
  for_each_segment([&](SegmentMarch m) { best = std::min(best, m.upper_bound()); });
  if (std::isinf(best)) {  // no site near any of it: farther than max_distance, if that is finite
    if (std::isinf(esdf_.max_distance)) return best;
    best = squared_far(esdf_);
  }
  for_each_segment([&](SegmentMarch m) { best = m.minimum(best); });
  return s * std::sqrt(best);
}

bool FreeSpace::is_free(const Point& p, double radius) const { return is_free(p, p, radius); }

bool FreeSpace::is_free(const Point& a, const Point& b, double radius) const {
  const double s = esdf_.voxel_size;
  if (!a.allFinite() || !b.allFinite()) return false;
  if (esdf_.unknown == UnknownPolicy::kIgnore && !is_known_free(a, b)) return false;
  return SegmentMarch(esdf_, a / s, b / s).stays_above(squared_limit(radius, s));
}

bool FreeSpace::is_clearly_free(const Point& a, const Point& b, double radius) const {
  const double s = esdf_.voxel_size;
  if (esdf_.unknown == UnknownPolicy::kIgnore && !is_known_free(a, b)) return false;
  return SegmentMarch(esdf_, a / s, b / s).stays_clearly_above(squared_limit(radius, s));
}

double FreeSpace::free_length(const Point& a, const Point& b, double radius) const {
  const double s = esdf_.voxel_size;
  const double length = (b - a).norm();
  double free = std::min(
      length, s * SegmentMarch(esdf_, a / s, b / s).first_doubt<true>(squared_limit(radius, s)));
  if (esdf_.unknown == UnknownPolicy::kIgnore)
    while (free > 0.0 && !is_known_free(a, a + (b - a) * (free / length)))
      free = free > s ? 0.5 * free : 0.0;
  return free;
}

bool FreeSpace::is_known_free(const Point& a, const Point& b) const {
  const Vector from = a / esdf_.voxel_size, along = b / esdf_.voxel_size - from;
  // Between two crossings of lattice planes the segment stays in one voxel: ask at its middle,
  // and at the crossing itself.
  double t = 0.0;
  if (!touches_free(esdf_, from) || !touches_free(esdf_, from + along)) return false;
  while (t < 1.0) {
    double next = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (along[axis] == 0.0) continue;
      const double here = from[axis] + t * along[axis];
      double plane =
          along[axis] > 0.0 ? std::floor(here + 1e-9) + 1.0 : std::ceil(here - 1e-9) - 1.0;
      next = std::min(next, (plane - from[axis]) / along[axis]);
    }
    if (!touches_free(esdf_, from + 0.5 * (t + next) * along) ||
        !touches_free(esdf_, from + next * along))
      return false;
    t = next;
  }
  return true;
}

double FreeSpace::slow_move_clearance(VoxelId from, VoxelId to, int direction,
                                      double enough) const {
  const double low = std::min(esdf_.squared[from], esdf_.squared[to]);
  if (low == kNoSite) return low;  // both ends farther than max_distance from everything
  const VoxelIndex v = esdf_.layout.index_of(from), o = offset_of(direction);
  const Vector a(v.x + 0.5, v.y + 0.5, v.z + 0.5), b = a + Vector(o.x, o.y, o.z);
  // Sites of the two ends first: near an obstacle one of them usually is the nearest on the way.
  double best = 0.25 * low;
  for (const VoxelId end : {from, to}) {
    if (esdf_.squared[end] == kNoSite) continue;
    const SiteOffset& site = esdf_.site[end];
    const VoxelIndex cube = (end == from ? v : v + o) + VoxelIndex{site.x, site.y, site.z};
    best = std::min(best, detail::squared_distance(a, b, detail::cube_of(cube)));
  }
  if (4.0 * best < enough - 1e-7) {
    if (enough < low) return 4.0 * best;  // the caller only asks whether it is enough
  }
  best = detail::ObstacleScan(esdf_, a, b).run(best);
  // Rounding must not make a level place look like a dip.
  return 4.0 * best > low - 1e-7 ? low : 4.0 * best;
}

}  // namespace ridgeway
