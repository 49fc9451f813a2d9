// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "experiments/maze.hpp"

#include <gtest/gtest.h>

#include "ridgeway/common/error.hpp"
#include "support/cancelling.hpp"

namespace ridgeway {
namespace {

MazeExperimentConfig small_maze_config() {
  MazeExperimentConfig config;
  config.maze.cells = 3;
  config.voxel_size = 0.2;
  config.pairs = 6;
  config.long_pairs = 1;
  config.repeat = 3;
  config.time_limit = 0.5;
  return config;
}

TEST(Maze, EveryPlannerAnswersEveryPair) {
  const MazeExperimentConfig config = small_maze_config();
  const MazeResult result = run_maze(config);
  ASSERT_EQ(result.rows.size(), 8u);
  EXPECT_EQ(result.rows.back().planner, "graph");
  for (const MazeRow& row : result.rows) {
    SCOPED_TRACE(row.planner);
    EXPECT_EQ(row.queries, row.planner == "rrtstar_10s" ? config.long_pairs : config.pairs);
    EXPECT_EQ(row.solved, row.queries);
    EXPECT_GT(row.seconds.median, 0.0);
    ASSERT_GE(row.single_path.size(), 2u);
    EXPECT_GT(row.single_length, 0.0);
  }
}

TEST(Maze, AnswersAreTheSameInEveryRound) {
  MazeExperimentConfig config = small_maze_config();
  const MazeResult thrice = run_maze(config);
  config.repeat = 1;
  const MazeResult once = run_maze(config);
  ASSERT_EQ(once.rows.size(), 8u);
  ASSERT_EQ(thrice.rows.size(), 8u);
  for (std::size_t i = 0; i < once.rows.size(); ++i) {
    if (once.rows[i].planner == "rrtstar_10s") continue;  // as far as it came in its time
    SCOPED_TRACE(once.rows[i].planner);
    EXPECT_EQ(once.rows[i].single_path, thrice.rows[i].single_path);
    EXPECT_EQ(once.rows[i].length.median, thrice.rows[i].length.median);
  }
}

TEST(Maze, RefusesWhatCannotBeRun) {
  MazeExperimentConfig config = small_maze_config();
  config.repeat = 0;
  EXPECT_THROW(run_maze(config), InputError);
  config = small_maze_config();
  config.min_clearance = 5.0;
  EXPECT_THROW(run_maze(config), InputError);
}

TEST(Maze, CanBeCancelled) {
  MazeExperimentConfig config = small_maze_config();
  config.repeat = 1;
  const auto planning = [&](const Progress& progress) { run_maze(config, progress); };
  // While the roadmap is built (nine times asked, or more), before the lengths, and with planners.
  for (const int stop : {0, 8, 9, 10, 12}) testing::expect_cancelled_at(stop, planning);
}

TEST(Maze, CanBeCancelledInAQueryThatTakesForEver) {
  MazeExperimentConfig config = small_maze_config();
  config.time_limit = 1e9;
  int asked = 0;
  const auto stop_in_the_long_one = [&](std::string_view stage, double) {
    return stage != "rrtstar_10s" || ++asked < 3;
  };
  EXPECT_THROW(run_maze(config, stop_in_the_long_one), Cancelled);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace ridgeway
