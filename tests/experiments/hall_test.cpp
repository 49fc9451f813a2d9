// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/hall.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mapping/memory_limit.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "sensing/poses.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

HallExperimentConfig small_hall_config() {
  HallExperimentConfig config;
  config.hall = {
      .length = 10.0, .width = 10.0, .height = 4.0, .tanks = 1, .machines = 2, .pipes = 1};
  config.voxel_sizes = {0.25};
  config.repeat = 1;
  config.queries = 20;
  config.copy_bytes = 1 << 20;
  return config;
}

std::vector<HallMap> maze() {
  return {{"maze", [] {
             const World world = make_maze({.cells = 3});
             const PoseSampling inside = sampling_inside(world);
             return occupancy_of(world, 0.15, {inside.low, inside.high});
           }}};
}

TEST(Hall, EveryMapHasARowForEveryNumberOfThreads) {
  const std::vector<HallRow> rows = run_hall(small_hall_config(), maze());
  ASSERT_EQ(rows.size(), 4u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].map, i < 2 ? "hall" : "maze");
    EXPECT_EQ(rows[i].voxel_size, i < 2 ? 0.25 : 0.15);
    EXPECT_EQ(rows[i].min_clearance, i < 2 ? 0.5 : 0.3);  // two voxels at least
    EXPECT_EQ(rows[i].threads, i % 2 == 0 ? 1 : 2);
    EXPECT_GT(rows[i].solved, 10u);
    EXPECT_GT(rows[i].batch_seconds, 0.0);
  }
}

TEST(Hall, ResultsDoNotDependOnTheNumberOfThreads) {
  const std::vector<HallRow> rows = run_hall(small_hall_config());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].counts.diagram_voxels, rows[1].counts.diagram_voxels);
  EXPECT_EQ(rows[0].vertices, rows[1].vertices);
  EXPECT_EQ(rows[0].edges, rows[1].edges);
  EXPECT_EQ(rows[0].solved, rows[1].solved);
}

TEST(Hall, StagesAddUp) {
  for (const HallRow& row : run_hall(small_hall_config())) {
    for (const StageNumbers* sum : {&row.seconds, &row.bytes}) {
      const double graph = sum->gvd + sum->edges + sum->thin + sum->kernel + sum->graph;
      EXPECT_NEAR(sum->esdf_to_graph, graph, 1e-9 * graph);
      EXPECT_GE(sum->total * (1.0 + 1e-9), sum->esdf + sum->esdf_to_graph + sum->attach);
    }
    EXPECT_EQ(row.voxels.esdf, static_cast<double>(row.counts.allocated_voxels));
    EXPECT_EQ(row.voxels.total, static_cast<double>(row.counts.voxels.known()));
    EXPECT_GT(row.copy_bandwidth, 0.0);
    EXPECT_GT(row.bandwidth_fraction(&StageNumbers::esdf), 0.0);
  }
}

TEST(Hall, PeakMemoryHoldsAllFieldsOfTheRoadmap) {
  HallExperimentConfig config = small_hall_config();
  config.voxel_sizes = {0.05};
  config.threads = {2};
  const std::vector<HallRow> rows = run_hall(config);
  ASSERT_TRUE(rows[0].peak_memory);
  const auto least = static_cast<double>(rows[0].counts.allocated_voxels) *
                     static_cast<double>(sizeof(VoxelState) + sizeof(NearSiteOffset) + 4 + 1);
  EXPECT_GT(static_cast<double>(*rows[0].peak_memory), least);
}

TEST(Hall, PeakMemoryIsThatOfOneMapAlone) {
  HallExperimentConfig config = small_hall_config();
  config.voxel_sizes = {0.05, 0.25};
  config.threads = {1};
  const std::vector<HallRow> rows = run_hall(config);
  ASSERT_TRUE(rows[0].peak_memory && rows[1].peak_memory);
  EXPECT_LT(*rows[1].peak_memory, *rows[0].peak_memory / 2);
}

/// 1,000 to 50,000 single voxels in a million, between which ridges are everywhere.
TEST(Hall, PeakMemoryIsNoMoreThanIsReckonedWith) {
  HallExperimentConfig config = small_hall_config();
  config.voxel_sizes = {0.06};
  config.min_clearance = 0.12;
  config.threads = {2};
  std::vector<HallMap> maps;
  for (const int in_thousand : {1, 10, 50})
    maps.push_back(
        {"salt", [in_thousand] {
           std::mt19937 random(7);
           return testing::make_map(0.06, {0, 0, 0}, {103, 103, 103}, [&](const VoxelIndex&) {
             return static_cast<int>(random() % 1000) < in_thousand ? VoxelState::kOccupied
                                                                    : VoxelState::kFree;
           });
         }});
  constexpr double kProgram = 3e7;  // bytes, whatever the map
  for (const HallRow& row : run_hall(config, maps)) {
    ASSERT_TRUE(row.peak_memory);
    const double reckoned =
        static_cast<double>(row.counts.allocated_voxels) * kPipelineBytesPerVoxel +
        static_cast<double>(row.counts.diagram_voxels) * kGraphBytesPerDiagramVoxel;
    EXPECT_LT(static_cast<double>(*row.peak_memory), kProgram + reckoned) << row.map;
  }
}

TEST(Hall, MapsThatCannotBeBuiltAreRefusedBeforeTheWork) {
  int made = 0;
  const HallMap bad{"bad", [&made]() -> OccupancyMap {
                      ++made;
                      throw InputError("bad", "is no map", "give another");
                    }};
  EXPECT_THROW(run_hall(small_hall_config(), {bad}), InputError);
  EXPECT_EQ(made, 1);  // here; before that in a process of its own
}

TEST(Hall, TheStoreGetsTheRoadmapAndAnswersFirst) {
  Roadmap kept;
  int saved = 0, loaded = 0;
  const RoadmapStore store{[&](const Roadmap& roadmap) {
                             kept = roadmap;
                             ++saved;
                           },
                           [&] {
                             ++loaded;
                             return kept;
                           }};
  HallExperimentConfig config = small_hall_config();
  config.repeat = 3;
  const std::vector<HallRow> rows = run_hall(config, {}, store);
  EXPECT_EQ(saved, 2);
  EXPECT_EQ(loaded, 6);
  for (const HallRow& row : rows) {
    EXPECT_GT(row.first_query_seconds, 0.0);
    EXPECT_GE(row.first_answer_seconds, row.load_seconds);
  }
}

TEST(Hall, WhatMakesNoSenseIsRefused) {
  const auto refuses = [](auto change) {
    HallExperimentConfig config = small_hall_config();
    change(config);
    EXPECT_THROW(run_hall(config), InputError);
  };
  refuses([](auto& config) { config.voxel_sizes = {}; });
  refuses([](auto& config) { config.voxel_sizes = {-0.1}; });
  refuses([](auto& config) { config.threads = {}; });
  refuses([](auto& config) { config.threads = {0}; });
  refuses([](auto& config) { config.repeat = 0; });
  refuses([](auto& config) { config.queries = 0; });
  refuses([](auto& config) { config.min_clearance = 0.0; });
}

}  // namespace
}  // namespace ridgeway
