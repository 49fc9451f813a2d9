// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "cylinder_scan.hpp"

#include <algorithm>
#include <cmath>

#include "box_distance.hpp"

namespace ridgeway::detail {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kPieceLength = 4.0;  // voxels of a segment at a time: its box stays small
constexpr double kRounding = 1e-9;    // of the radius and the height: what touches does not collide

/// The part of a segment, shares of it, at which the cylinder reaches into a layer of voxels.
struct Part {
  double begin = 0.0, end = 1.0;
  bool is_empty() const { return begin > end; }
};

Part part_in_layer(double z0, double z1, double layer, double half_height) {
  const double low = layer - half_height, high = layer + 1.0 + half_height;  // of the centre
  const double along = z1 - z0;
  if (along == 0.0) return z0 > low && z0 < high ? Part{} : Part{1.0, 0.0};
  const double to_low = (low - z0) / along, to_high = (high - z0) / along;
  Part part{std::max(0.0, std::min(to_low, to_high)), std::min(1.0, std::max(to_low, to_high))};
  if (part.begin == part.end && (part.begin == 0.0 || part.end == 1.0)) return {1.0, 0.0};
  return part;
}

/// Whether a piece of a segment keeps clear of the voxels of one layer.
bool is_clear_of_layer(const EsdfMap& esdf, VoxelFinder& finder, const Vector& a, const Vector& b,
                       int layer, double radius) {
  const VoxelIndex low = voxel_at(Vector(a.cwiseMin(b) - Vector::Constant(radius)), 1.0);
  const VoxelIndex high = voxel_at(Vector(a.cwiseMax(b) + Vector::Constant(radius)), 1.0);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      if (!esdf.is_obstacle(finder.find({x, y, layer}))) continue;
      // Flat: heights count no more.
      const VoxelBox box{Vector(x, y, 0.0), Vector(x + 1.0, y + 1.0, 0.0)};
      const Vector p(a.x(), a.y(), 0.0), q(b.x(), b.y(), 0.0);
      const double squared = p == q ? squared_distance(p, box) : squared_distance(p, q, box);
      if (squared < radius * radius) return false;
    }
  return true;
}

bool piece_is_free(const EsdfMap& esdf, VoxelFinder& finder, const Vector& a, const Vector& b,
                   double radius, double half_height) {
  const int first = floor_to_int(std::min(a.z(), b.z()) - half_height);
  const int last = floor_to_int(std::max(a.z(), b.z()) + half_height);
  for (int layer = first; layer <= last; ++layer) {
    const Part part = part_in_layer(a.z(), b.z(), layer, half_height);
    if (!part.is_empty() &&
        !is_clear_of_layer(esdf, finder, a + part.begin * (b - a), a + part.end * (b - a), layer,
                           radius))
      return false;
  }
  return true;
}

}  // namespace

bool cylinder_is_free(const EsdfMap& esdf, const Vector& a, const Vector& b, double radius,
                      double half_height) {
  VoxelFinder finder(esdf.layout);
  const double pieces = std::max(1.0, std::ceil((b - a).norm() / kPieceLength));
  for (double k = 0.0; k < pieces; ++k)
    if (!piece_is_free(esdf, finder, a + (b - a) * (k / pieces), a + (b - a) * ((k + 1.0) / pieces),
                       radius * (1.0 - kRounding), half_height * (1.0 - kRounding)))
      return false;
  return true;
}

}  // namespace ridgeway::detail
