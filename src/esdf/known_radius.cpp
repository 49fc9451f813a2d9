// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "known_radius.hpp"

#include <string>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

[[noreturn]] void refuse_radius(const EsdfMap& esdf, const char* name, double radius) {
  throw InputError(std::string(name) + " " + number_text(radius),
                   "is beyond the distances that the map holds, which are known up to " +
                       number_text(esdf.max_distance) + " m (radii up to two voxels less)",
                   "build the map with a larger max_distance, or without one");
}

}  // namespace

double largest_radius(const EsdfMap& esdf) {
  constexpr double kRounding = 1.0 + 1e-9;
  return (esdf.max_distance - 2.0 * esdf.voxel_size) * kRounding;
}

void detail::require_known_distance(const EsdfMap& esdf, double radius) {
  if (radius > esdf.max_distance) refuse_radius(esdf, "radius", radius);
}

void detail::require_known_radius(const EsdfMap& esdf, const char* name, double radius) {
  if (radius > largest_radius(esdf)) refuse_radius(esdf, name, radius);
}

}  // namespace ridgeway
