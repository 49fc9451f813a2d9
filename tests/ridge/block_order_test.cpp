// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// A roadmap does not depend on how its map's blocks came to be stored: the same bytes in its file,
// the same answers from memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "files/read_file.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/formats/load_map.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

/// The map with its blocks in a random order, added `at_once` at a time, its field growing along.
OccupancyMap grown(const OccupancyMap& map, unsigned seed, std::size_t at_once) {
  std::vector<BlockIndex> blocks(map.layout.blocks().begin(), map.layout.blocks().end());
  std::shuffle(blocks.begin(), blocks.end(), std::mt19937(seed));
  OccupancyMap result;
  result.voxel_size = map.voxel_size;
  result.origin = map.origin;
  result.state = VoxelField<VoxelState>(result.layout);
  for (std::size_t first = 0; first < blocks.size(); first += at_once) {
    const auto more = std::span(blocks).subspan(first, std::min(at_once, blocks.size() - first));
    result.layout.add(more);
    result.state.grow(result.layout, VoxelState::kUnknown);
    for (const BlockIndex& block : more)
      std::copy_n(map.state.block(map.layout.find_block(block)), kBlockVoxels,
                  result.state.block(result.layout.find_block(block)));
  }
  return result;
}

struct Answers {
  std::string file;                           // the .ridge file's bytes
  std::vector<std::vector<Point>> waypoints;  // of plans between fixed places
  std::vector<PlanStatus> statuses;
};

/// Places drawn from the known bounds: free and not.
std::vector<Point> random_places(const OccupancyMap& map, std::size_t count) {
  const Box bounds = known_bounds(map).value();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Point> places;
  while (places.size() < count) {
    const Point p(share(random), share(random), share(random));
    places.emplace_back(bounds.min + p.cwiseProduct(bounds.max - bounds.min));
  }
  return places;
}

void ask(const Roadmap& roadmap, const std::vector<Point>& places, Answers& answers) {
  const auto note = [&](const PlanResult& result) {
    answers.waypoints.push_back(result.waypoints);
    answers.statuses.push_back(result.status);
  };
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    for (const Planner planner :
         {Planner::kGraph, Planner::kDiagram, Planner::kEsdf, Planner::kThetaStar})
      note(plan(roadmap, places[i], places[i + 1], {.planner = planner}));
}

/// Nothing where no voxel is traversable.
std::optional<Answers> answers_of(const OccupancyMap& map, const BuildConfig& config, int threads,
                                  const std::vector<Point>& places) {
  return with_threads(threads, [&]() -> std::optional<Answers> {
    try {
      const Roadmap roadmap = build_roadmap(map, config).roadmap;
      const TemporaryFolder folder;
      save_roadmap(roadmap, folder / "map.ridge");
      Answers answers{read_file(folder / "map.ridge"), {}, {}};
      ask(roadmap, places, answers);
      return answers;
    } catch (const InputError&) {
      return std::nullopt;
    }
  });
}

/// Returns whether there was a roadmap to compare.
bool expect_same_in_any_order(const OccupancyMap& map, const BuildConfig& config, unsigned seed,
                              std::size_t at_once, const std::vector<Point>& places) {
  const auto batch = answers_of(map, config, 1, places);
  const OccupancyMap other = grown(map, seed, at_once);
  for (const int threads : {1, 2}) {
    const auto same = answers_of(other, config, threads, places);
    EXPECT_EQ(batch.has_value(), same.has_value());
    if (!batch || !same) return false;
    EXPECT_TRUE(batch->file == same->file) << threads << " threads";
    EXPECT_EQ(batch->statuses, same->statuses) << threads << " threads";
    EXPECT_TRUE(batch->waypoints == same->waypoints) << threads << " threads";
  }
  return true;
}

class BlockOrder : public ::testing::TestWithParam<UnknownPolicy> {};

TEST_P(BlockOrder, OfRandomMapsLeavesNoTraceInTheFileAndThePlans) {
  int built = 0, shuffled = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = testing::random_map(seed, seed % 5 == 0 ? 60 : 24);
    const BuildConfig config{.min_clearance = 0.06 + 0.03 * (seed % 3), .unknown = GetParam()};
    built +=
        expect_same_in_any_order(map, config, seed, seed % 2 == 0 ? 1 : 5, random_places(map, 4));
    shuffled += !grown(map, seed, 1).layout.is_in_order();
    if (HasFailure()) return;
  }
  EXPECT_GT(built, 30);
  EXPECT_GT(shuffled, 30);
}

TEST_P(BlockOrder, OfARealScanLeavesNoTraceInTheFileAndThePlans) {
  const OccupancyMap map =
      load_map(std::filesystem::path(RIDGEWAY_DATA_DIR) / "fr_079.bt", {.voxel_size = 0.1});
  const BuildConfig config{.min_clearance = 0.3, .unknown = GetParam()};
  EXPECT_TRUE(expect_same_in_any_order(map, config, 1, 97, random_places(map, 12)));
}

INSTANTIATE_TEST_SUITE_P(BothPolicies, BlockOrder,
                         ::testing::Values(UnknownPolicy::kObstacle, UnknownPolicy::kIgnore));

}  // namespace
}  // namespace ridgeway
