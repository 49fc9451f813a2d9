// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"

namespace ridgeway {
namespace {

constexpr double kOnTheFace = 1e-8;  // metres: the rounding of coordinates in the size of a country

bool contains(const Box& box, const Point& p) {
  return (p.array() >= box.min.array() - kOnTheFace).all() &&
         (p.array() <= box.max.array() + kOnTheFace).all();
}

/// Whether a segment enters a box, grown by a margin, without its faces.
bool enters(const Box& box, const Point& a, const Point& b, double margin) {
  double first = 0.0, last = 1.0;  // share of the segment between the faces so far
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis] + kOnTheFace - margin;
    const double high = box.max[axis] - kOnTheFace + margin;
    const double along = b[axis] - a[axis];
    if (along == 0.0) {
      if (a[axis] <= low || a[axis] >= high) return false;
      continue;
    }
    const double to_low = (low - a[axis]) / along, to_high = (high - a[axis]) / along;
    first = std::max(first, std::min(to_low, to_high));
    last = std::min(last, std::max(to_low, to_high));
    if (first >= last) return false;  // what only touches a face or an edge stays outside
  }
  return true;
}

}  // namespace

bool FlightLimits::any() const { return !(*this == FlightLimits{}); }

bool FlightLimits::keeps_in(const Point& p) const { return contains(keep_in, p); }

bool FlightLimits::allow(const Point& a, const Point& b) const { return allow(a, b, 0.0); }

bool FlightLimits::allow(const Point& a, const Point& b, double margin) const {
  return contains(keep_in, a) && contains(keep_in, b) &&
         std::none_of(keep_out.begin(), keep_out.end(),
                      [&](const Box& box) { return enters(box, a, b, margin); });
}

bool FlightLimits::allow(std::span<const Point> path) const {
  if (path.size() == 1) return allow(path.front());
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!allow(path[i - 1], path[i])) return false;
  return true;
}

bool FlightLimits::allow_voxel(const VoxelIndex& voxel, double voxel_size) const {
  const Point centre = centre_of(voxel, voxel_size);
  if (!contains(keep_in, centre)) return false;
  const double half = 0.5 * voxel_size - kOnTheFace;
  const auto is_shared = [&](const Box& box) {
    return ((centre - box.max).array() < half).all() && ((box.min - centre).array() < half).all();
  };
  return std::none_of(keep_out.begin(), keep_out.end(), is_shared);
}

void FlightLimits::validate() const {
  validate_box(keep_in, "keep_in");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (keep_in.min.maxCoeff() == kInfinity || keep_in.max.minCoeff() == -kInfinity)
    throw InputError("keep_in", "holds no place", "give it faces that are not all at infinity");
  for (std::size_t i = 0; i < keep_out.size(); ++i) {
    const std::string name = "keep_out box " + std::to_string(i + 1);
    validate_box(keep_out[i], name);
    if (!((keep_out[i].max - keep_out[i].min).minCoeff() > 2.0 * kOnTheFace))
      throw InputError(name, "has no volume",
                       "give it a length along every axis; in a plane any two heights do");
  }
}

bool operator==(const FlightLimits& a, const FlightLimits& b) {
  const auto is_same = [](const Box& c, const Box& d) { return c.min == d.min && c.max == d.max; };
  return is_same(a.keep_in, b.keep_in) && std::equal(a.keep_out.begin(), a.keep_out.end(),
                                                     b.keep_out.begin(), b.keep_out.end(), is_same);
}

FlightLimits both_of(const FlightLimits& a, const FlightLimits& b) {
  FlightLimits both = a;
  both.keep_in.min = a.keep_in.min.cwiseMax(b.keep_in.min);
  both.keep_in.max = a.keep_in.max.cwiseMin(b.keep_in.max);
  both.keep_out.insert(both.keep_out.end(), b.keep_out.begin(), b.keep_out.end());
  return both;
}

namespace {

/// Limits whose faces are moved as places; those at infinity stay there.
template <typename Move>
FlightLimits moved_limits(const FlightLimits& limits, const Move& move) {
  const auto corner = [&](const Point& p) {
    Point finite = p;
    for (double& x : finite)
      if (!std::isfinite(x)) x = 0.0;
    const Point result = move(finite);
    return Point(p.array().isFinite().select(result.array(), p.array()));
  };
  FlightLimits result{{corner(limits.keep_in.min), corner(limits.keep_in.max)}, {}};
  for (const Box& box : limits.keep_out)
    result.keep_out.push_back({corner(box.min), corner(box.max)});
  return result;
}

}  // namespace

FlightLimits limits_in_local(const EsdfMap& esdf, const FlightLimits& limits_world) {
  FlightLimits local =
      moved_limits(limits_world, [&](const Point& p) { return to_local(esdf, p); });
  if (!esdf.planar) return local;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  local.keep_in.min.z() = -kInfinity;
  local.keep_in.max.z() = kInfinity;
  for (Box& box : local.keep_out) {  // all of the block
    box.min.z() = 0.0;
    box.max.z() = kBlockSide * esdf.voxel_size;
  }
  return local;
}

FlightLimits limits_in_world(const EsdfMap& esdf) {
  return moved_limits(esdf.limits, [&](const Point& p) { return to_world(esdf, p); });
}

bool has_flight_limits(const EsdfMap& esdf, FlightLimits limits) {
  if (esdf.planar) {
    limits.keep_in.min.z() = FlightLimits{}.keep_in.min.z();
    limits.keep_in.max.z() = FlightLimits{}.keep_in.max.z();
  }
  return limits.any();
}

void require_room(const EsdfMap& esdf, const FlightLimits& limits) {
  const double s = esdf.voxel_size;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = limits.keep_in.min[axis], high = limits.keep_in.max[axis];
    const double first = std::ceil((low - kOnTheFace) / s - 0.5) + 0.5;  // centre, voxels
    if (first * s <= high + kOnTheFace) continue;
    if (low > high)
      throw InputError(
          "flight limits",
          std::string("do not meet those that the map was built with along ") + "xyz"[axis],
          "give limits that lie within them");
    throw InputError("flight limits",
                     std::string("hold the centre of no voxel along ") + "xyz"[axis],
                     "give limits that are at least a voxel apart");
  }
}

}  // namespace ridgeway
