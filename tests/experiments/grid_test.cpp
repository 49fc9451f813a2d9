// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/read_file.hpp"
#include "formats/benchmark_map.hpp"
#include "formats/benchmark_scenarios.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

/// The bundled map with its first scenarios.
GridBenchmark bundled(std::size_t count) {
  const std::string file = std::string(RIDGEWAY_DATA_DIR) + "/warframe/Simple.3dmap";
  GridBenchmark benchmark{"Simple", read_benchmark_map(read_file(file), file, 1.0), {}};
  for (const BenchmarkScenario& scenario :
       read_benchmark_scenarios(read_file(file + ".3dscen"), file).scenarios)
    if (benchmark.scenarios.size() < count)
      benchmark.scenarios.push_back(
          {centre_of(scenario.start, 1.0), centre_of(scenario.goal, 1.0), scenario.optimal_length});
  return benchmark;
}

TEST(Grid, EveryScenarioOfTheBundleIsSolvedNearItsOptimum) {
  const GridRow row = run_grid(bundled(250), {.exact = 250});
  ASSERT_EQ(row.scenarios.size(), 250u);
  EXPECT_EQ(row.solvable, 250u);
  EXPECT_EQ(row.optimum_checked, 250u);
  EXPECT_EQ(row.optimum_reproduced, 250u);
  EXPECT_GT(row.vertices, 1u);
  for (const GridAnswers* answers : {&row.raw, &row.shortened}) {
    EXPECT_EQ(answers->solved, 250u);
    EXPECT_EQ(answers->within_violations, 0u);
    ASSERT_EQ(answers->ratios.size(), 250u);
    EXPECT_EQ(*std::max_element(answers->ratios.begin(), answers->ratios.end()),
              answers->length_over_optimum.max);
    // At any angle no path is shorter than the lattice's but for its directions.
    for (const double ratio : answers->ratios) EXPECT_GT(ratio, 0.8);
  }
  EXPECT_LE(row.shortened.length_over_optimum.median, 1.0);
  EXPECT_LE(row.shortened.length_over_optimum.p95, 1.03);
  EXPECT_LE(row.shortened.length_over_optimum.p99, 1.10);
  for (std::size_t i = 0; i < 250; ++i)
    EXPECT_LE(row.shortened.ratios[i], row.raw.ratios[i] * (1.0 + 1e-9)) << i;
}

TEST(Grid, ASubsetIsSpreadOverAllScenarios) {
  const GridRow all = run_grid(bundled(10), {.exact = 0}),
                some = run_grid(bundled(10), {.scenarios = 4, .exact = 0});
  EXPECT_EQ(some.scenarios, (std::vector<std::size_t>{0, 2, 5, 7}));
  for (std::size_t i = 0; i < some.scenarios.size(); ++i)
    EXPECT_EQ(some.shortened.ratios[i], all.shortened.ratios[some.scenarios[i]]);
  EXPECT_EQ(run_grid(bundled(10), {.scenarios = 99, .exact = 0}).scenarios.size(), 10u);
  EXPECT_EQ(some.optimum_checked, 0u);
}

TEST(Grid, WhatHasNoPathIsNeitherSolvedNorSolvable) {
  GridBenchmark benchmark = bundled(3);
  GridScenario& outside = benchmark.scenarios[1];
  outside.goal = Point(-50.0, 0.5, 0.5);
  benchmark.scenarios[2].optimum *= 1.01;  // no optimum
  const GridRow row = run_grid(std::move(benchmark));
  EXPECT_EQ(row.scenarios.size(), 3u);
  EXPECT_EQ(row.shortened.solved, 2u);
  EXPECT_EQ(row.raw.solved, 2u);
  EXPECT_EQ(row.solvable, 2u);
  EXPECT_TRUE(std::isnan(row.shortened.ratios[1]));
  EXPECT_EQ(row.optimum_checked, 3u);
  EXPECT_EQ(row.optimum_reproduced, 1u);
}

TEST(Grid, PathsThatAreLongerThanTheySayAreCounted) {
  GridBenchmark benchmark = bundled(4);
  benchmark.scenarios[2].optimum *= 0.3;  // as if a path so short had been found
  EXPECT_EQ(run_grid(std::move(benchmark), {.exact = 0}).shortened.within_violations, 1u);
}

TEST(Grid, WhatMakesNoSenseIsRefused) {
  EXPECT_THROW(run_grid(bundled(1), {.min_clearance = 0.0}), InputError);
  EXPECT_THROW(run_grid(bundled(1), {.optimum_accuracy = 1.0}), InputError);
  EXPECT_THROW(run_grid(bundled(0)), InputError);
  GridBenchmark benchmark = bundled(2);
  benchmark.scenarios[1].optimum = 0.0;
  EXPECT_THROW(run_grid(std::move(benchmark)), InputError);
}

TEST(Grid, CanBeCancelled) {
  const auto stop_at_queries = [](std::string_view stage, double) { return stage != "graph"; };
  EXPECT_THROW(run_grid(bundled(3), {}, stop_at_queries), Cancelled);
}

}  // namespace
}  // namespace ridgeway
