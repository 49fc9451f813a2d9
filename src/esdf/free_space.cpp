// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/esdf/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cylinder_room.hpp"
#include "cylinder_scan.hpp"
#include "segment_march.hpp"

namespace ridgeway {
namespace {

using detail::SegmentMarch;
using detail::squared_far;
using detail::voxel_holding;
using detail::Wanted;
using Vector = Eigen::Vector3d;

/// Squared radius, voxel units, that a squared distance has to reach.
double squared_limit(double radius, double voxel_size) {
  return 0.25 * least_clearance(radius, voxel_size).value;
}

/// The longest part up to `most` that holds, less a step at most; whatever is longer than one that
/// does not hold does not either. 0 where none holds.
template <typename Holds>
double longest_that_holds(double most, double step, const Holds& holds) {
  if (most <= 0.0 || holds(most)) return most;
  double good = 0.0, bad = most;
  while (bad - good > step) {
    const double middle = 0.5 * (good + bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

/// Whether there are voxels at both ends, and a radius that something may keep.
bool can_ask(const EsdfMap& esdf, const Point& a, const Point& b, double radius) {
  return has_voxel(a, esdf.voxel_size) && has_voxel(b, esdf.voxel_size) && radius >= 0.0;
}

/// Whether a point lies in, or on the border of, a known-free voxel: but for rounding, also of the
/// world's coordinates, where waypoints of paths were rounded.
bool touches_free(const EsdfMap& esdf, VoxelFinder& finder, const Vector& p) {
  if (esdf.is_open(finder.find(voxel_holding(p)))) return true;
  const double slack = detail::rounding(esdf);
  const VoxelIndex low = voxel_holding(p - Vector::Constant(slack));
  const VoxelIndex high = voxel_holding(p + Vector::Constant(slack));
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        if (esdf.is_open(finder.find({x, y, z}))) return true;
      }
  return false;
}

/// Where, after its part t, a segment crosses a plane of a lattice of cubes of a side; 1 if
/// nowhere.
double next_crossing(const Vector& from, const Vector& along, double t, double side) {
  double next = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.0) continue;
    const double here = (from[axis] + t * along[axis]) / side, off = 1e-9 / side;
    const double plane =
        along[axis] > 0.0 ? std::floor(here + off) + 1.0 : std::ceil(here - off) - 1.0;
    next = std::min(next, (side * plane - from[axis]) / along[axis]);
  }
  return std::max(next, std::nextafter(t, 1.0));  // far out a plane may be where it was
}

/// Whether all voxels of a block are open, as far as that can be told at a glance.
bool is_open_block(const EsdfMap& esdf, std::uint32_t slot) {
  if (esdf.unknown != UnknownPolicy::kFree || slot == BlockLayout::kNoBlock) return false;
  const VoxelMask::Block& obstacles = esdf.obstacle.block(slot);
  return std::all_of(obstacles.begin(), obstacles.end(), [](std::uint64_t z) { return z == 0; });
}

/// Whether centres may be at both ends of a segment: that is told at once, and where one is far
/// from all that is known the rest is not.
bool ends_are_known_free(const FreeSpace& space, const Point& a, const Point& b) {
  return space.map().unknown == UnknownPolicy::kObstacle ||
         (space.is_known_free(a, a) && space.is_known_free(b, b));
}

}  // namespace

double FreeSpace::distance(const Point& p) const { return clearance(p, p); }

double FreeSpace::clearance(const Point& a, const Point& b) const {
  const std::array<Point, 2> path{a, b};
  return clearance(path);
}

double FreeSpace::clearance(std::span<const Point> path, double at_most) const {
  const double s = esdf_.voxel_size;
  if (!std::all_of(path.begin(), path.end(), [&](const Point& p) { return has_voxel(p, s); }))
    return 0.0;
  const auto for_each_segment = [&](const auto& body) {
    for (std::size_t i = path.size() == 1 ? 0 : 1; i < path.size(); ++i)
      body(SegmentMarch(esdf_, path[i == 0 ? 0 : i - 1] / s, path[i] / s));
  };
  // A good bound first: then only the narrowest places are looked at closely.
  double best = at_most / s * (at_most / s);
  if (std::isinf(esdf_.max_distance) && best > squared_far(esdf_))
    best = detail::kInfinity;  // no site is so far
  for_each_segment([&](SegmentMarch m) { best = m.upper_bound(best); });
  if (std::isinf(best)) {  // no site near any of it: farther than max_distance, if that is finite
    if (std::isinf(esdf_.max_distance)) return best;
    best = squared_far(esdf_);
  }
  for_each_segment([&](SegmentMarch m) {
    if (best > 0.0) best = m.minimum(best);
  });
  return s * std::sqrt(best);
}

bool FreeSpace::is_free(const Point& p, double radius) const { return is_free(p, p, radius); }

bool FreeSpace::is_free(const Point& a, const Point& b, double radius) const {
  const double s = esdf_.voxel_size;
  if (!can_ask(esdf_, a, b, radius) || !is_within_limits(a, b) || !ends_are_known_free(*this, a, b))
    return false;
  const auto fits = [&](double ball) {
    return std::isinf(
        SegmentMarch(esdf_, a / s, b / s).doubt<Wanted::kWhether>(squared_limit(ball, s)));
  };
  const auto cylinder_fits = [&] {
    return fits(outer_radius(radius)) ||
           (fits(inner_radius(radius)) &&
            detail::cylinder_is_free(esdf_, a / s, b / s, radius / s, half_height(radius) / s));
  };
  return (is_for_sphere() ? fits(radius) : cylinder_fits()) &&
         (esdf_.unknown == UnknownPolicy::kObstacle || is_known_free(a, b));
}

bool FreeSpace::is_clearly_free(const Point& a, const Point& b, double radius) const {
  if (!is_for_sphere()) return is_free(a, b, radius);
  const double s = esdf_.voxel_size;
  if (!can_ask(esdf_, a, b, radius) || !is_within_limits(a, b) || !ends_are_known_free(*this, a, b))
    return false;
  return std::isinf(SegmentMarch(esdf_, a / s, b / s)
                        .doubt<Wanted::kWhetherClearly>(squared_limit(radius, s))) &&
         (esdf_.unknown == UnknownPolicy::kObstacle || is_known_free(a, b));
}

double FreeSpace::free_length(const Point& a, const Point& b, double radius) const {
  return length_until<Wanted::kWhere>(a, b, radius);
}

double FreeSpace::clear_length(const Point& a, const Point& b, double radius) const {
  return length_until<Wanted::kWhereClearly>(a, b, radius);
}

template <auto wanted>
double FreeSpace::length_until(const Point& a, const Point& b, double radius) const {
  const double s = esdf_.voxel_size;
  if (!can_ask(esdf_, a, b, radius)) return 0.0;
  const double length = (b - a).norm();
  if (!is_for_sphere()) {
    return longest_that_holds(
        length, s, [&](double free) { return is_free(a, a + (b - a) * (free / length), radius); });
  }
  const double free = std::min(
      length, s * SegmentMarch(esdf_, a / s, b / s).doubt<wanted>(squared_limit(radius, s)));
  return longest_that_holds(free, s, [&](double part) {
    const Point end = a + (b - a) * (part / length);
    return is_within_limits(a, end) &&
           (esdf_.unknown == UnknownPolicy::kObstacle || is_known_free(a, end));
  });
}

std::optional<Point> FreeSpace::near_obstacle(const Point& p) const {
  if (!has_voxel(p, esdf_.voxel_size)) return std::nullopt;
  const VoxelIndex v = voxel_at(p, esdf_.voxel_size);
  const VoxelId id = esdf_.layout.find(v);
  if (id == kNoVoxel || esdf_.squared[id] == kNoSite) return std::nullopt;
  const SiteOffset site = esdf_.site[id];
  const Point low = Point(v.x + site.x, v.y + site.y, v.z + site.z) * esdf_.voxel_size;
  return p.cwiseMax(low).cwiseMin(low + Point::Constant(esdf_.voxel_size));
}

bool FreeSpace::is_known_free(const Point& a, const Point& b) const {
  if (!can_ask(esdf_, a, b, 0.0)) return false;
  const Vector from = a / esdf_.voxel_size, along = b / esdf_.voxel_size - from;
  VoxelFinder finder(esdf_.layout);
  if (!touches_free(esdf_, finder, from) || !touches_free(esdf_, finder, from + along))
    return false;
  // Between two crossings of lattice planes the segment stays in one voxel: ask at its middle. The
  // crossings are on the border of what lies before and behind.
  for (double t = 0.0; t < 1.0;) {
    double next = next_crossing(from, along, t, 1.0);
    const Vector middle = from + 0.5 * (t + next) * along;
    if (!touches_free(esdf_, finder, middle)) return false;
    if (is_open_block(esdf_, finder.find_block(block_of(voxel_holding(middle)))))
      next = std::max(next, next_crossing(from, along, t, kBlockSide));
    t = next;
  }
  return true;
}

bool FreeSpace::cylinder_fits(VoxelId from, VoxelId to) const {
  const double s = esdf_.voxel_size;
  const VoxelIndex a = esdf_.layout.index_of(from), b = esdf_.layout.index_of(to), o = b - a;
  const SquaredHalves bound = move_bound(esdf_.known_squared(from), esdf_.known_squared(to),
                                         o.x * o.x + o.y * o.y + o.z * o.z);
  if (bound >= least_clearance(outer_radius_, s)) return true;
  if (room_ != nullptr) {
    const detail::CylinderRoom::Answer answer = room_->ask(from, to);
    if (answer != detail::CylinderRoom::Answer::kUnclear)
      return answer == detail::CylinderRoom::Answer::kFree;
  }
  return is_free(centre_of(a, s), centre_of(b, s), radius_);
}

bool FreeSpace::touches_no_obstacle(VoxelId from, int direction) const {
  const VoxelIndex& o = offset_of(direction);
  for (int axes = 1; axes < 7; ++axes) {  // a bit for each along which the other voxel is
    const VoxelIndex part{axes & 1 ? o.x : 0, axes & 2 ? o.y : 0, axes & 4 ? o.z : 0};
    if (part == VoxelIndex{0, 0, 0} || part == o) continue;
    if (esdf_.is_obstacle(esdf_.layout.neighbour(from, direction_of(part)))) return false;
  }
  return true;
}

SquaredHalves FreeSpace::slow_move_clearance(VoxelId from, VoxelId to, int direction,
                                             SquaredHalves enough) const {
  if (direction < kCentre) {  // the same both ways, to the last bit
    std::swap(from, to);
    direction = opposite(direction);
  }
  const SquaredHalves low = std::min(esdf_.squared[from], esdf_.squared[to]);
  if (low == SquaredHalves(kNoSite))
    return low;  // both ends farther than max_distance from everything
  const VoxelIndex v = esdf_.layout.index_of(from), o = offset_of(direction);
  const Vector a(v.x + 0.5, v.y + 0.5, v.z + 0.5), b = a + Vector(o.x, o.y, o.z);
  // Sites of the two ends first: near an obstacle one of them usually is the nearest on the way.
  double best = 0.25 * low.value;
  for (const VoxelId end : {from, to}) {
    if (esdf_.squared[end] == kNoSite) continue;
    const SiteOffset site = esdf_.site[end];
    const VoxelIndex cube = (end == from ? v : v + o) + VoxelIndex{site.x, site.y, site.z};
    best = std::min(best, detail::squared_distance(a, b, detail::cube_of(cube)));
  }
  if (4.0 * best < enough.value - 1e-7) {
    if (enough < low)
      return SquaredHalves(4.0 * best);  // the caller only asks whether it is enough
  }
  best =
      detail::ObstacleScan(esdf_, a, b).run_across(best);  // how near they are at the ends is known
  // Rounding must not make a level place look like a dip.
  return 4.0 * best > low.value - 1e-7 ? low : SquaredHalves(4.0 * best);
}

}  // namespace ridgeway
