// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "expected_volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "field_along.hpp"

namespace ridgeway::detail {
namespace {

constexpr double kBetweenRays = 7.5 * std::numbers::pi / 180.0;  // 0.9 m at 7 m
constexpr double kStep = 0.2;      // metres of unknown space that are looked at together, at least
constexpr double kMeanFree = 4.0;  // metres that a ray gets into unknown space, on average
constexpr double kNegligible = 0.05;  // a ray that gets on as rarely ends

/// The volume, m^3 per steradian, that is expected to be measured along a ray.
double volume_along(const EsdfMap& esdf, const VoxelRange& within, const Point& from,
                    const Eigen::Vector3d& direction, double range) {
  const double s = esdf.voxel_size, step = std::max(kStep, s);
  const double kept = std::exp(-step / kMeanFree);
  FieldAlong field(esdf);
  double volume = 0.0, gets_on = 1.0;
  for (double t = 0.0; t < range && gets_on > kNegligible;) {
    const VoxelIndex voxel = voxel_at(from + t * direction, s);
    field.move_to(voxel);
    if (field.squared() != 0) {  // free
      t += std::max(field.distance() - 2.0 * s, step);
      continue;
    }
    if (field.is_occupied()) break;
    if (!within.contains(voxel + esdf.origin)) break;
    const double share = t / range;
    volume += gets_on * (1.0 - share * share) * t * t * step;
    gets_on *= kept;
    t += step;
  }
  return volume;
}

}  // namespace

double expected_voxels(const EsdfMap& esdf, const FieldOfView& view, const VoxelRange& within,
                       const Point& from, double yaw) {
  const auto pieces_of = [](double angle) {
    return std::max(1, static_cast<int>(std::lround(angle / kBetweenRays)));
  };
  const int columns = pieces_of(view.horizontal), rows = pieces_of(view.vertical);
  const double across = view.horizontal / columns, down = view.vertical / rows;
  const double steepest = std::tan(0.5 * view.vertical);
  double volume = 0.0;
  for (int column = 0; column < columns; ++column) {
    const double aside = (column + 0.5) * across - 0.5 * view.horizontal;
    const Eigen::Vector3d level(std::cos(yaw + aside), std::sin(yaw + aside), 0.0);
    const double forward = view.is_all_around() ? 1.0 : std::cos(aside);
    for (int row = 0; row < rows; ++row) {
      const double elevation = (row + 0.5) * down - 0.5 * view.vertical;
      const double flat = std::cos(elevation), rise = std::sin(elevation);
      if (std::abs(rise) > steepest * flat * forward) continue;  // the view is a pyramid
      const Eigen::Vector3d direction = flat * level + rise * Point::UnitZ();
      volume += flat * across * down * volume_along(esdf, within, from, direction, view.range);
    }
  }
  return volume / (esdf.voxel_size * esdf.voxel_size * esdf.voxel_size);
}

}  // namespace ridgeway::detail
