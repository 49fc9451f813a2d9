// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdlib>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/sampling/ompl.hpp"
#include "ridgeway/sampling/plan_by_sampling.hpp"

// Crosses an empty room.
int main() {
  ridgeway::OccupancyBuilder builder(0.1);
  builder.fill({{0, 0, 0}, {29, 29, 29}}, ridgeway::VoxelState::kFree);
  const ridgeway::EsdfMap esdf = ridgeway::compute_esdf(std::move(builder).finish());
  const auto result =
      ridgeway::plan_by_sampling(esdf, {0.5, 0.5, 0.5}, {2.5, 2.5, 2.5}, {.radius = 0.2});
  return result.plan.ok() ? EXIT_SUCCESS : EXIT_FAILURE;
}
