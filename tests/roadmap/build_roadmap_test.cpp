// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/build_roadmap.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/roadmap/build_graph.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "ridgeway/skeleton/basins.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/compute_skeleton.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

/// Exit code: 0 where build_roadmap refuses a map for the memory that it would take. To be called
/// in a process of its own, whose address space it bounds to a few megabytes more than it has.
[[noreturn]] void build_with_little_memory(const OccupancyMap& map) {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  statm.close();
  const rlim_t megabytes = 24;
  const rlimit limit{pages * 4096 + megabytes * 1000000, RLIM_INFINITY};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(3);
  try {
    with_threads(1, [&] { build_roadmap(map, {.min_clearance = 0.3}); });
  } catch (const InputError& error) {
    std::_Exit(
        error.where() == "map" && error.problem().find("of memory") != std::string::npos ? 0 : 2);
  } catch (...) {
  }
  std::_Exit(1);
}

TEST(BuildRoadmapDeathTest, RefusesAMapThatMemoryWouldNotDoFor) {
  const OccupancyMap map =  // of 2 MB; 31 MB at least as a roadmap is made of it
      testing::make_map(0.1, {0, 0, 0}, {127, 127, 127}, [](const VoxelIndex& v) {
        return v.z == 0 ? VoxelState::kOccupied : VoxelState::kFree;
      });
  EXPECT_EXIT(build_with_little_memory(map), ::testing::ExitedWithCode(0), "");
}

TEST(BuildRoadmap, RefusesAMapAtTheEndOfTheWorldAndAPolicyThatIsNone) {
  const auto build_at = [](int block) {
    OccupancyMap map;
    map.voxel_size = 0.1;
    map.layout = BlockLayout({{block, 0, 0}});
    map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
    return build_roadmap(std::move(map), {.min_clearance = 0.1}).report.traversable_voxels;
  };
  constexpr int kFarthest = kMaxVoxelIndex / kBlockSide;
  for (const int block : {-kFarthest, 0, kFarthest}) EXPECT_GT(build_at(block), 0u);
  for (const int block : {268435456, -268435456, 1 << 30, kFarthest + 2})
    EXPECT_THROW(build_at(block), InputError);
  EXPECT_THROW(build_roadmap(testing::random_map(1), {.unknown = static_cast<UnknownPolicy>(3)}),
               InputError);
}

TEST(BuildRoadmap, RefusesSizesOfVoxelsAndRadiiThatAreNone) {
  OccupancyMap map = testing::random_map(1);
  for (const double size : {0.0, -1.0, 1e-7, 2e6, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    map.voxel_size = size;
    EXPECT_THROW(build_roadmap(map, {.min_clearance = 0.1}), InputError) << size;
    EXPECT_THROW(compute_esdf(map), InputError) << size;
  }
  map.voxel_size = 0.1;
  try {  // farther than any site that a voxel may have
    build_roadmap(map, {.min_clearance = 0.1 * kFarthestSite, .unknown = UnknownPolicy::kFree});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "min_clearance");
  }
  const EsdfMap esdf = compute_esdf(map);
  const VoxelMask free = traversable_voxels(esdf, 0.05);
  for (const double radius :
       {-0.3, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(traversable_voxels(esdf, radius), InputError) << radius;
    EXPECT_THROW(find_basins(esdf, free, radius), InputError) << radius;
    EXPECT_THROW(build_cell_graph(esdf, radius), InputError) << radius;
    EXPECT_THROW(SpaceParts(esdf).report(radius), InputError) << radius;
  }
}

/// Beyond max_distance nothing is known, so nothing is far enough.
TEST(BuildRoadmap, StagesRefuseRadiiThatTheirFieldDoesNotKnow) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {31, 31, 15}, [](const VoxelIndex& v) {
    return v.x == 16 && v.y < 20 ? VoxelState::kOccupied : VoxelState::kFree;
  });
  const EsdfMap near = compute_esdf(map, {.max_distance = 0.5}), far = compute_esdf(map);
  EXPECT_EQ(traversable_voxels(near, 0.5).count(), traversable_voxels(far, 0.5).count());
  EXPECT_THROW(traversable_voxels(near, 0.55), InputError);
  const VoxelMask diagram = compute_skeleton(near, 0.3);
  EXPECT_GT(diagram.count(), 0u);
  EXPECT_THROW(compute_skeleton(near, 0.4), InputError);
  EXPECT_THROW(build_graph(near, diagram, {.min_clearance = 0.4}), InputError);
  const SparseGraph wide = build_graph(far, compute_skeleton(far, 0.4), {.min_clearance = 0.4});
  EXPECT_THROW(simplify_graph(near, wide), InputError);
}

/// Asked again within a stage, the answer counts: stages of large maps take seconds.
TEST(BuildRoadmap, CanBeCancelledWithinAStageAndBuiltAgain) {
  Random random(5);
  const OccupancyMap map =
      testing::make_map(0.1, {0, 0, 0}, {127, 127, 47}, [&](const VoxelIndex&) {
        return random.uniform() < 0.002 ? VoxelState::kOccupied : VoxelState::kFree;
      });
  std::string last;
  bool is_within = false;
  const Progress stop_within = [&](std::string_view stage, double) {
    is_within = stage == last;
    last = stage;
    return !is_within;
  };
  EXPECT_THROW(build_roadmap(map, {.min_clearance = 0.3}, stop_within), Cancelled);
  EXPECT_TRUE(is_within);
  EXPECT_NE(last, "done");

  const BuildConfig config = {.min_clearance = 0.3, .tangent_pairs = 0};
  const Progress watch = [](std::string_view, double) { return true; };
  const Roadmap watched = build_roadmap(map, config, watch).roadmap;
  const Roadmap plain = build_roadmap(map, config).roadmap;
  EXPECT_EQ(watched.diagram.voxels, plain.diagram.voxels);
  EXPECT_EQ(watched.graph.edges.size(), plain.graph.edges.size());
}

}  // namespace
}  // namespace ridgeway
