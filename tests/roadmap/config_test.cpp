// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRoomRadius = 0.2;

OccupancyMap room() {
  return testing::make_map(0.1, {0, 0, 0}, {15, 15, 15},
                           [](const VoxelIndex&) { return VoxelState::kFree; });
}

/// What the stages work on.
struct Stages {
  Roadmap roadmap = build_roadmap(room(), {.min_clearance = kRoomRadius}).roadmap;
  VoxelMask traversable = traversable_voxels(roadmap.esdf, kRoomRadius);
};

/// A floating-point field of a configuration, by the stage that takes it.
struct Field {
  std::string name;
  std::vector<double> refused;
  std::function<void(const Stages&, double)> run;
};

/// Runs a stage with one field of its configuration changed.
template <typename Config, typename Stage>
std::function<void(const Stages&, double)> with(double Config::*field, const Stage& stage) {
  return [field, stage](const Stages& stages, double value) {
    Config config;
    config.*field = value;
    stage(stages, config);
  };
}

std::vector<Field> all_fields() {
  const auto gvd = [](const Stages& s, const GvdConfig& c) {
    compute_gvd(s.roadmap.esdf, s.traversable, c);
  };
  const auto basis_points = [](const Stages& s, const GvdConfig& c) {
    extract_basis_point_edges(s.roadmap.esdf, s.traversable, c);
  };
  const auto graph = [](const Stages& s, const GraphConfig& c) {
    build_graph(s.roadmap.esdf, s.roadmap.diagram.voxels, c);
  };
  const auto simplify = [](const Stages& s, const SimplifyConfig& c) {
    simplify_graph(s.roadmap.esdf, s.roadmap.graph, c);
  };
  const auto build = [](const Stages&, const BuildConfig& c) { build_roadmap(room(), c); };
  const auto esdf = [](const Stages&, const EsdfConfig& c) { compute_esdf(room(), c); };
  const std::vector<double> not_a_length{kNaN, kInfinity, -kInfinity, -0.1, -1e300};
  std::vector<double> not_above_zero = not_a_length;
  not_above_zero.push_back(0.0);
  const std::vector<double> no_angle{kNaN, kInfinity, -kInfinity, -0.1, 0.0, 3.2, 1e300};
  const std::vector<double> no_limit{kNaN, -kInfinity, -0.1, 0.0};
  const std::vector<double> no_stretch{kNaN, kInfinity, -kInfinity, -1.0, 0.0, 0.999};
  return {
      {"theta", no_angle, with(&GvdConfig::theta, gvd)},
      {"theta", no_angle, with(&GvdConfig::theta, basis_points)},
      {"min_clearance", not_above_zero, with(&GraphConfig::min_clearance, graph)},
      {"prune_radius", not_a_length, with(&GraphConfig::prune_radius, graph)},
      {"split_deviation", not_a_length, with(&GraphConfig::split_deviation, graph)},
      {"widest_kept", not_a_length, with(&GraphConfig::widest_kept, graph)},
      {"significance", not_a_length, with(&SimplifyConfig::significance, simplify)},
      {"steepness", not_a_length, with(&SimplifyConfig::steepness, simplify)},
      {"widest_kept", not_a_length, with(&SimplifyConfig::widest_kept, simplify)},
      {"width_step", not_above_zero, with(&SimplifyConfig::width_step, simplify)},
      {"stretch", no_stretch, with(&SimplifyConfig::stretch, simplify)},
      {"min_clearance", not_above_zero, with(&BuildConfig::min_clearance, build)},
      {"theta", no_angle, with(&BuildConfig::theta, build)},
      {"prune_radius", not_a_length, with(&BuildConfig::prune_radius, build)},
      {"split_deviation", not_a_length, with(&BuildConfig::split_deviation, build)},
      {"significance", not_a_length, with(&BuildConfig::significance, build)},
      {"max_distance", no_limit, with(&BuildConfig::max_distance, build)},
      {"max_distance", no_limit, with(&EsdfConfig::max_distance, esdf)},
  };
}

TEST(Configurations, RefuseWhatIsNoNumberOrOutOfRangeWhereAStageBegins) {
  const Stages stages;
  for (const Field& field : all_fields())
    for (const double value : field.refused) {
      SCOPED_TRACE(field.name + " " + std::to_string(value));
      try {
        field.run(stages, value);
        ADD_FAILURE() << "is taken";
      } catch (const InputError& error) {
        EXPECT_EQ(error.where(), field.name);
      }
    }
}

TEST(Configurations, RefuseMorePairsOfPlacesThanThereIsTimeFor) {
  const Stages stages;
  EXPECT_THROW(build_tangent_graph(stages.roadmap, {.tangent_pairs = static_cast<std::size_t>(-1)}),
               InputError);
  EXPECT_THROW(build_roadmap(room(), {.tangent_pairs = static_cast<std::size_t>(-1)}), InputError);
}

}  // namespace
}  // namespace ridgeway
