// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>

#include "common/require.hpp"
#include "obstacle_scan.hpp"
#include "ridgeway/esdf/distance_field.hpp"

namespace ridgeway {
namespace {

using detail::require;

/// Distance, voxels, from a centre to the cube at an offset.
double distance_to_cube(int dx, int dy, int dz) {
  return 0.5 * std::sqrt(static_cast<double>(squared_halves(dx) + squared_halves(dy) +
                                             squared_halves(dz)));
}

/// Distance, voxels, from an obstacle voxel's centre to the nearest cube that is no obstacle, at
/// most `deepest`: shell by shell outward, until no nearer cube can come.
double depth(const EsdfMap& esdf, const VoxelIndex& voxel, double deepest) {
  double best = deepest;
  for (int shell = 1; shell - 0.5 < best; ++shell)
    for (int dz = -shell; dz <= shell; ++dz)
      for (int dy = -shell; dy <= shell; ++dy) {
        const bool face = std::abs(dz) == shell || std::abs(dy) == shell;
        for (int dx = -shell; dx <= shell; dx += face ? 1 : 2 * shell) {
          const double distance = distance_to_cube(dx, dy, dz);
          if (distance < best &&
              !esdf.is_obstacle(esdf.layout.find(voxel + VoxelIndex{dx, dy, dz})))
            best = distance;
        }
      }
  return best;
}

/// Distance, metres, of a voxel beside the map, in whose block nothing is known and which is no
/// obstacle: measured, as no field has it. At most `far`; that where nothing is known beside it, or
/// no obstacle is anywhere.
double distance_beside(const EsdfMap& esdf, const VoxelIndex& voxel, double far) {
  const double s = esdf.voxel_size;
  double most = far / s;
  bool is_beside = false, has_site = most < kFarthestSite;
  for (int d = 0; d < 27; ++d) {
    const VoxelIndex o = offset_of(d);
    const VoxelId id = esdf.layout.find(voxel + o);
    is_beside |= id != kNoVoxel;
    if (id == kNoVoxel || esdf.squared[id] == kNoSite) continue;
    has_site = true;
    const double off = Point(o.x, o.y, o.z).norm();
    most = std::min(most, esdf.distance(id) / s + off);
  }
  if (!is_beside || !has_site) return far;
  constexpr double kSlack = 1e-6;  // the scan looks for what is nearer
  const Point centre = centre_of(voxel, 1.0);
  const double squared = detail::ObstacleScan(esdf, centre, centre).run(most * most + kSlack);
  return std::min(far, s * std::sqrt(squared));
}

void require_depth(double deepest) {
  require(deepest >= 0.0 && std::isfinite(deepest), "deepest", deepest,
          "give the metres that are looked at inside obstacles, 0 or more");
}

double distance_of(const EsdfMap& esdf, const VoxelIndex& voxel, double deepest) {
  const double s = esdf.voxel_size;
  const double far = std::min(esdf.max_distance, kFarthestSite * s);
  const VoxelId id = esdf.layout.find(voxel);
  if (esdf.is_obstacle(id)) return -s * depth(esdf, voxel, deepest / s);
  return id == kNoVoxel ? distance_beside(esdf, voxel, far) : std::min(esdf.distance(id), far);
}

}  // namespace

double signed_distance(const EsdfMap& esdf, const VoxelIndex& voxel, double deepest) {
  require_depth(deepest);
  if (!kAllVoxels.contains(voxel))
    throw InputError("voxel", "is none that a map may have", "give one within 1e9 of its zero");
  return distance_of(esdf, voxel, deepest);
}

DistanceAndGradient interpolate_distance(const EsdfMap& esdf, const Point& point, double deepest) {
  require_depth(deepest);
  const double s = esdf.voxel_size;
  if (!has_voxel(point, s))
    throw InputError("point", "is no place that a map may have", "give finite metres");
  const Point shifted = point / s - Point::Constant(0.5);
  const VoxelIndex base = voxel_at(shifted, 1.0);
  const Point t = shifted - Point(base.x, base.y, base.z);
  std::array<double, 8> d;  // bit 0: x, bit 1: y, bit 2: z
  for (int i = 0; i < 8; ++i)
    d[static_cast<std::size_t>(i)] =
        distance_of(esdf, base + VoxelIndex{i & 1, i >> 1 & 1, i >> 2}, deepest);
  const auto mix = [](double a, double b, double share) { return a + share * (b - a); };
  const double x00 = mix(d[0], d[1], t.x()), x10 = mix(d[2], d[3], t.x());
  const double x01 = mix(d[4], d[5], t.x()), x11 = mix(d[6], d[7], t.x());
  const double y0 = mix(x00, x10, t.y()), y1 = mix(x01, x11, t.y());
  DistanceAndGradient result;
  result.distance = mix(y0, y1, t.z());
  result.gradient.x() =
      mix(mix(d[1] - d[0], d[3] - d[2], t.y()), mix(d[5] - d[4], d[7] - d[6], t.y()), t.z());
  result.gradient.y() = mix(x10 - x00, x11 - x01, t.z());
  result.gradient.z() = y1 - y0;
  result.gradient /= s;
  return result;
}

std::optional<DistanceAndGradient> distance_at(const EsdfMap& esdf, const Point& point_world,
                                               double deepest) {
  const Point local = flight_place(esdf, point_world);
  if (!has_voxel(local, esdf.voxel_size)) return std::nullopt;
  const VoxelId id = esdf.layout.find(voxel_at(local, esdf.voxel_size));
  if (id == kNoVoxel || esdf.state[id] == VoxelState::kUnknown) return std::nullopt;
  DistanceAndGradient found = interpolate_distance(esdf, local, deepest);
  // Where no obstacle is, whatever max_distance; optimisers do with the largest number there is.
  if (found.distance >= kFarthestSite * esdf.voxel_size) found.distance = esdf.max_distance;
  return found;
}

}  // namespace ridgeway
