// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// An update that runs out of memory, at any allocation of it, leaves all as it was.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <new>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/live/live_roadmap.hpp"
#include "ridgeway/mapping/tsdf_fusion.hpp"
#include "ridgeway/voxel/block_layout.hpp"
#include "sensing/poses.hpp"
#include "sensing/world_generators.hpp"
#include "support/random_changes.hpp"
#include "support/temporary_folder.hpp"

namespace {

std::atomic<long> allocations_left = -1;  // until one fails; below zero: none does

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  void* memory =
      alignment <= alignof(std::max_align_t)
          ? std::malloc(bytes)
          : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes, 1); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return std::malloc(bytes);  // who asks so does without
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace ridgeway {
namespace {

struct Scan {
  DepthImage image;
  Eigen::Isometry3d T_world_camera;
};

DepthSensor small_sensor() {
  DepthSensor sensor;
  sensor.camera = {.width = 64, .height = 48, .fx = 32.0, .fy = 32.0, .cx = 31.5, .cy = 23.5};
  return sensor;
}

std::vector<Scan> scans_of_house() {
  const World world = make_house();
  std::vector<Scan> scans;
  for (const Eigen::Isometry3d& pose :
       sample_poses(world, {.low = {1, 1, 1}, .high = {14, 10, 4}, .count = 3, .seed = 2}))
    scans.push_back({render_depth(world, small_sensor(), pose), pose});
  return scans;
}

enum class Ending : std::uint8_t {
  kFailed,   ///< by std::bad_alloc
  kInSpite,  ///< done, though an allocation failed: streams that read the system's files do without
  kInTime,   ///< done before so many allocations
};

template <typename Update>
Ending ending_of(long allocations, const Update& update) {
  allocations_left = allocations;
  Ending ending = Ending::kFailed;
  try {
    update();
    ending = allocations_left < 0 ? Ending::kInSpite : Ending::kInTime;
  } catch (const std::bad_alloc&) {
  }
  allocations_left = -1;
  return ending;
}

TEST(OutOfMemory, LeavesMapAndSnapshotAndWhatComesAfterAsTheyWere) {
  const std::vector<Scan> scans = scans_of_house();
  const PinholeCamera camera = small_sensor().camera;
  const LiveConfig config = {
      .fusion = {.voxel_size = 0.4, .clear_radius = 0.6},
      .build = {.min_clearance = 0.3, .max_distance = 2.0, .tangent_pairs = 20}};
  const auto integrate = [&](LiveRoadmap& live, const Scan& scan) {
    live.integrate(scan.image, camera, scan.T_world_camera);
  };
  const auto after_two = [&] {
    LiveRoadmap live(config);
    for (std::size_t i = 0; i < 2; ++i) integrate(live, scans[i]);
    return live;
  };
  LiveRoadmap live = after_two(), undisturbed = after_two();
  int failed = 0;
  with_threads(1, [&] {
    auto snapshot = live.snapshot();
    const std::vector<VoxelChange> map = testing::changes_to(live.map());
    for (long allocations = 0;; allocations += allocations < 300 ? 1 : allocations / 50) {
      const Ending ending = ending_of(allocations, [&] { integrate(live, scans[2]); });
      if (ending == Ending::kInTime) break;
      if (ending == Ending::kInSpite) {
        live = after_two();
        snapshot = live.snapshot();
        continue;
      }
      ++failed;
      ASSERT_EQ(live.snapshot(), snapshot) << allocations;
      ASSERT_TRUE(testing::changes_to(live.map()) == map) << allocations;
    }
    integrate(undisturbed, scans[2]);
  });
  EXPECT_GT(failed, 300);
  const auto a = live.snapshot(), b = undisturbed.snapshot();
  EXPECT_TRUE(testing::changes_to(live.map()) == testing::changes_to(undisturbed.map()));
  EXPECT_EQ(a->graph.vertices.size(), b->graph.vertices.size());
  for (const VoxelChange& change : testing::changes_to(live.map())) {
    const VoxelIndex own = change.voxel - a->esdf.origin;
    const VoxelId at = a->esdf.layout.find(own), same = b->esdf.layout.find(own);
    ASSERT_EQ(a->esdf.squared[at], b->esdf.squared[same]);
    ASSERT_EQ(a->attach.next[at], b->attach.next[same]);
    ASSERT_EQ(a->diagram.voxels.test(at), b->diagram.voxels.test(same));
  }
}

TEST(OutOfMemory, LayoutsStayAsTheyWere) {
  const std::vector<BlockIndex> first = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 2, 1}};
  // Within the box, beyond it, so far that it is looked up by hash.
  const std::vector<BlockIndex> more = {{2, 2, 1}, {-4, 5, 0}, {90'000, -7, 80'000}, {2, 2, 1}};
  int failed = 0;
  for (std::size_t count = 1; count <= more.size(); ++count)
    for (long allocations = 0;; ++allocations) {
      BlockLayout layout(first);
      const Ending ending =
          ending_of(allocations, [&] { layout.add(std::span(more).first(count)); });
      if (ending == Ending::kInTime) break;
      ++failed;
      ASSERT_EQ(layout.block_count(), first.size());
      for (const BlockIndex& block : first)
        ASSERT_EQ(layout.block(layout.find_block(block)), block) << allocations;
      for (const BlockIndex& block : more)
        ASSERT_EQ(layout.find_block(block), BlockLayout::kNoBlock) << allocations;
    }
  EXPECT_GT(failed, 10);
}

TEST(OutOfMemory, FusionIsAsItWasOnceUndone) {
  const std::vector<Scan> scans = scans_of_house();
  const PinholeCamera camera = small_sensor().camera;
  TsdfFusion fusion({.voxel_size = 0.4, .clear_radius = 0.6, .can_undo = true});
  fusion.integrate(scans[0].image, camera, scans[0].T_world_camera);
  fusion.accept_changes();
  const std::vector<VoxelChange> before = testing::changes_to(occupancy_of(fusion.map()));
  int failed = 0;
  with_threads(1, [&] {
    for (long allocations = 0;; ++allocations) {
      const Ending ending = ending_of(
          allocations, [&] { fusion.integrate(scans[1].image, camera, scans[1].T_world_camera); });
      fusion.undo();
      ASSERT_TRUE(testing::changes_to(occupancy_of(fusion.map())) == before) << allocations;
      if (ending == Ending::kInTime) break;
      ++failed;
    }
  });
  EXPECT_GT(failed, 100);
}

/// The last allocations of an update, where all but the log is done.
TEST(OutOfMemory, ScansThatAreKeptEndWithTheUpdate) {
  const std::vector<Scan> scans = scans_of_house();
  const PinholeCamera camera = small_sensor().camera;
  const TemporaryFolder folder;
  constexpr long kMany = 1'000'000, kLast = 40;
  long used = 0;
  with_threads(1, [&] {
    for (long run = -1; run < kLast; ++run) {
      LiveRoadmap live({.fusion = {.voxel_size = 0.4},
                        .build = {.min_clearance = 0.3, .max_distance = 2.0, .tangent_pairs = 0},
                        .log_folder = folder / "log",
                        .log_bytes = 20'000});  // of one scan and a half
      const auto integrate = [&](const Scan& scan) {
        live.integrate(scan.image, camera, scan.T_world_camera);
      };
      for (std::size_t i = 0; i < 2; ++i) integrate(scans[i]);
      const auto snapshot = live.snapshot();
      if (run < 0) {
        allocations_left = kMany;
        integrate(scans[2]);
        used = kMany - allocations_left.exchange(-1);
        continue;
      }
      const Ending ending = ending_of(used - 1 - run, [&] { integrate(scans[2]); });
      ASSERT_EQ(ending == Ending::kFailed, live.snapshot() == snapshot) << run;
      if (ending == Ending::kFailed) integrate(scans[2]);
      integrate(scans[1]);  // what is counted of frames and blocks still fits
    }
  });
  EXPECT_GT(used, kLast);
  EXPECT_FALSE(std::filesystem::exists(folder / "log"));  // nothing is left behind
}

}  // namespace
}  // namespace ridgeway
