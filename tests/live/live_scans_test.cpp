// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
// Poses that are corrected, worlds that change, windows: what comes of scans that were fused.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "house_flight.hpp"
#include "live/corrected_scans.hpp"
#include "ridgeway/common/parallel.hpp"
#include "support/random_changes.hpp"
#include "support/refusal.hpp"

namespace ridgeway {
namespace {

using testing::batch_bytes;
using testing::bytes_of;
using testing::flight_through_house;
using testing::house_config;
using testing::Scan;
using testing::sensor_of_flight;

UpdateReport integrate(LiveRoadmap& live, const Scan& scan) {
  return live.integrate(scan.image, sensor_of_flight().camera, scan.T_world_camera);
}

/// As a tracker that drifts has it.
Eigen::Isometry3d drifted(const Eigen::Isometry3d& pose, double by) {
  Eigen::Isometry3d off = pose;
  off.translation() += Point(by, -0.5 * by, 0.2 * by);
  off.rotate(Eigen::AngleAxisd(0.2 * by, Eigen::Vector3d::UnitY()));
  return off;
}

LiveConfig with_log(const TemporaryFolder& folder) {
  LiveConfig config = house_config();
  config.log_folder = folder / "log";
  return config;
}

TEST(CorrectPoses, GivesTheBytesOfFusingAllWithTheCorrectedPoses) {
  const std::vector<Scan> scans = flight_through_house(9);
  for (const int threads : {1, 2})
    with_threads(threads, [&] {
      const TemporaryFolder folder;
      const LiveConfig config = with_log(folder);
      LiveRoadmap live(config);
      std::vector<Eigen::Isometry3d> first;
      for (std::size_t i = 0; i < scans.size(); ++i) {
        const double drift = i < 3 ? 0.0 : 0.15 * static_cast<double>(i);
        first.push_back(drifted(scans[i].T_world_camera, drift));
        integrate(live, {scans[i].image, first.back()});
      }
      const std::string before = bytes_of(live.settled().get());
      // Some of them first, then all; the origin is that of the first pose as it was.
      LiveConfig plain = house_config();
      plain.fusion.origin = plain.origin =
          voxel_at(first.front().translation(), plain.fusion.voxel_size);
      std::vector<PoseCorrection> corrections;
      for (const std::size_t last : {5u, 9u}) {
        corrections.clear();
        for (std::size_t i = 0; i < last; ++i)
          corrections.push_back({i + 1, scans[i].T_world_camera});
        const UpdateReport report = live.correct_poses(corrections);
        EXPECT_GT(report.fused_again, 0u);
        EXPECT_GT(report.changed_voxels, 0u);
        LiveRoadmap fused(plain);
        for (std::size_t i = 0; i < scans.size(); ++i)
          integrate(fused, {scans[i].image, i < last ? scans[i].T_world_camera : first[i]});
        EXPECT_TRUE(testing::changes_to(live.map()) == testing::changes_to(fused.map())) << last;
        EXPECT_TRUE(bytes_of(live.settled().get()) == bytes_of(fused.settled().get())) << last;
        EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), config.build));
      }
      EXPECT_FALSE(bytes_of(live.settled().get()) == before);
      EXPECT_EQ(live.correct_poses(corrections).fused_again, 0u);  // as they are already
      // And goes on from there.
      LiveRoadmap fused(plain);
      for (const Scan& scan : scans) integrate(fused, scan);
      const Scan next = flight_through_house(10).back();
      integrate(live, next);
      integrate(fused, next);
      EXPECT_TRUE(bytes_of(live.settled().get()) == bytes_of(fused.settled().get()));
    });
}

/// A flight whose tracker drifts, and what fusing it with the true poses of some frames gives.
class DriftingFlight {
 public:
  explicit DriftingFlight(std::size_t count) : scans_(flight_through_house(count)) {
    poses_.push_back(drifted(scans_.front().T_world_camera, 1.0));  // by half a block
    for (std::size_t i = 1; i < scans_.size(); ++i)
      poses_.push_back(drifted(scans_[i].T_world_camera, 0.1 * static_cast<double>(i)));
  }

  void integrate_into(LiveRoadmap& live, std::size_t first, std::size_t last) const {
    for (std::size_t i = first; i < last; ++i) integrate(live, {scans_[i].image, poses_[i]});
  }
  std::vector<PoseCorrection> corrections(std::size_t first, std::size_t last) const {
    std::vector<PoseCorrection> list;
    for (std::size_t i = first; i < last; ++i) list.push_back({i + 1, scans_[i].T_world_camera});
    return list;
  }
  std::string bytes_with(std::size_t first, std::size_t last) const {
    LiveConfig config = house_config();
    config.fusion.origin = config.origin =
        voxel_at(poses_.front().translation(), config.fusion.voxel_size);
    LiveRoadmap fused(config);
    for (std::size_t i = 0; i < scans_.size(); ++i)
      integrate(fused,
                {scans_[i].image, i >= first && i < last ? scans_[i].T_world_camera : poses_[i]});
    return bytes_of(fused.settled().get());
  }

 private:
  std::vector<Scan> scans_;
  std::vector<Eigen::Isometry3d> poses_;
};

TEST(CorrectPoses, AfterTheFirstPoseWasCorrectedOthersCanBe) {
  const DriftingFlight flight(6);
  const TemporaryFolder folder;
  LiveRoadmap live(with_log(folder));
  flight.integrate_into(live, 0, 6);
  live.correct_poses(flight.corrections(0, 2));
  EXPECT_GT(live.correct_poses(flight.corrections(2, 4)).fused_again, 0u);
  EXPECT_TRUE(bytes_of(live.settled().get()) == flight.bytes_with(0, 4));
}

TEST(CorrectPoses, GoOnInAThreadOfTheirOwnWhileScansAreFused) {
  const DriftingFlight flight(9);
  const TemporaryFolder folder;
  LiveConfig config = with_log(folder);
  config.log_bytes = 300'000;  // three images: none may go before all are fused again
  LiveRoadmap live(config);
  flight.integrate_into(live, 0, 3);
  EXPECT_TRUE(live.is_correction_ready());
  const UpdateReport nothing = live.finish_correcting();  // as nothing was begun
  EXPECT_EQ(nothing.fused_again, 0u);
  EXPECT_EQ(nothing.version, 3u);
  EXPECT_TRUE(nothing.has_roadmap);
  live.begin_correcting(flight.corrections(0, 2));
  flight.integrate_into(live, 3, 5);
  live.begin_correcting(flight.corrections(2, 4));  // both, anew
  flight.integrate_into(live, 5, 9);
  for (int tries = 0; !live.is_correction_ready() && tries < 6'000; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(live.is_correction_ready());
  EXPECT_GT(live.finish_correcting().fused_again, 0u);
  EXPECT_TRUE(bytes_of(live.settled().get()) == flight.bytes_with(0, 4));
  EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), config.build));
  EXPECT_THROW(live.correct_poses(flight.corrections(8, 9)), InputError);  // the oldest have gone
}

TEST(CorrectPoses, WhatWaitsOutsideOfAWindowIsCorrectedToo) {
  const DriftingFlight flight(7);
  const TemporaryFolder folder;
  LiveConfig config = with_log(folder);
  config.window = 2.0;
  LiveRoadmap live(config);
  flight.integrate_into(live, 0, 5);
  EXPECT_GT(live.correct_poses(flight.corrections(0, 4)).waiting_voxels, 0u);
  EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), config.build));
  flight.integrate_into(live, 5, 7);
  EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), config.build));
  EXPECT_EQ(live.catch_up().waiting_voxels, 0u);
  EXPECT_TRUE(bytes_of(live.settled().get()) == flight.bytes_with(0, 4));
}

TEST(FrameIndex, RemembersOfFramesThatAreLostTheFirst) {
  detail::FrameIndex index;
  const std::vector<BlockIndex> seen{{1, 2, 3}};
  constexpr std::size_t kKept = 20, kFrames = 5'000;
  for (std::size_t frame = 0; frame < kFrames; ++frame)
    index.add(Eigen::Isometry3d::Identity(), seen, frame < kKept ? 0 : frame - kKept);
  const std::vector<std::uint32_t>& frames = index.of_block.at(seen.front());
  EXPECT_LE(frames.capacity(), 8 * kKept);
  EXPECT_EQ(frames.front(), 0u);
  for (std::size_t k = 1; k <= kKept; ++k) EXPECT_EQ(frames[frames.size() - k], kFrames - k);
  EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end()));
}

TEST(CorrectPoses, WhatCannotBeFusedAgainIsGivenUp) {
  const DriftingFlight flight(5);
  const TemporaryFolder folder;
  LiveConfig config = with_log(folder);
  LiveRoadmap live(config);
  flight.integrate_into(live, 0, 4);
  std::filesystem::remove(config.log_folder / "scan-2.bin");
  const auto snapshot = live.snapshot();
  live.begin_correcting(flight.corrections(0, 4));
  EXPECT_NE(refusal([&] { live.finish_correcting(); }).find("scan-2.bin"), std::string::npos);
  EXPECT_EQ(live.snapshot(), snapshot);
  EXPECT_TRUE(live.is_correction_ready());
  flight.integrate_into(live, 4, 5);
  EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), config.build));
  live.begin_correcting(flight.corrections(0, 5));  // and a roadmap may go while one is under way
}

TEST(CorrectPoses, FusesAgainOnlyWhatMovedFramesReach) {
  const std::vector<Scan> scans = flight_through_house(6);
  const TemporaryFolder folder;
  LiveRoadmap live(with_log(folder));
  std::vector<Eigen::Isometry3d> live_poses;
  for (const Scan& scan : scans) {
    integrate(live, scan);
    live_poses.push_back(scan.T_world_camera);
  }
  const auto fused_again = [&](std::size_t first) {
    std::vector<PoseCorrection> corrections;
    for (std::size_t i = first; i < scans.size(); ++i)
      corrections.push_back({i + 1, drifted(live_poses[i], 0.1)});
    for (const PoseCorrection& c : corrections) live_poses[c.frame - 1] = c.T_world_sensor;
    return live.correct_poses(corrections).fused_again;
  };
  const std::size_t one = fused_again(5), all = fused_again(0);
  EXPECT_GT(one, 0u);
  EXPECT_LT(2 * one, all);
}

TEST(CorrectPoses, RefusesWhatItCannotDoAndStaysAsItWas) {
  const std::vector<Scan> scans = flight_through_house(4);
  LiveRoadmap without(house_config());
  integrate(without, scans[0]);
  const auto correction = [&](std::uint64_t frame) {
    return std::vector<PoseCorrection>{{frame, drifted(scans[0].T_world_camera, 0.3)}};
  };
  EXPECT_THROW(without.correct_poses(correction(1)), InputError);  // no log

  const TemporaryFolder folder;
  LiveConfig config = with_log(folder);
  config.log_bytes = 200'000;  // two images
  LiveRoadmap live(config);
  for (const Scan& scan : scans) integrate(live, scan);
  std::uintmax_t kept = 0;
  for (const auto& file : std::filesystem::directory_iterator(config.log_folder))
    kept += file.file_size();
  EXPECT_LE(kept, config.log_bytes);
  EXPECT_GT(kept, 0u);
  const auto snapshot = live.snapshot();
  const auto refused = [&](const std::string& name, const std::vector<PoseCorrection>& wrong) {
    try {
      live.correct_poses(wrong);
      ADD_FAILURE() << name << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
    EXPECT_EQ(live.snapshot(), snapshot);
  };
  refused("frame 0", correction(0));
  refused("frame 5", correction(5));
  refused("frame 1", correction(1));  // has left the log
  std::vector<PoseCorrection> sheared = correction(4);
  sheared[0].T_world_sensor.linear() *= 1.1;
  refused("frame 4", sheared);
  EXPECT_GT(integrate(live, flight_through_house(5).back()).changed_voxels, 0u);
  EXPECT_NE(live.snapshot(), snapshot);
}

TEST(CorrectPoses, WantsAFolderOfItsOwnAndLeavesNothingThere) {
  const TemporaryFolder folder;
  {
    const LiveConfig config = with_log(folder);
    LiveRoadmap live(config);
    integrate(live, flight_through_house(1)[0]);
    EXPECT_THROW(LiveRoadmap{config}, InputError);  // in use
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "log"));
}

TEST(LiveWindow, WhatIsFarWaitsAndIsNotLost) {
  const std::vector<Scan> scans = flight_through_house(6);
  LiveConfig near = house_config();
  near.window = 3.0;
  near.fusion.clear_radius = 0.0;
  LiveConfig far = near;
  far.window = std::numeric_limits<double>::infinity();
  LiveRoadmap live(near), whole(far);
  std::size_t waited = 0;
  for (const Scan& scan : scans) {
    const UpdateReport report = integrate(live, scan);
    integrate(whole, scan);
    waited += report.waiting_voxels > 0;
    EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), near.build));
    EXPECT_LE(count_voxels(live.map()).known(), count_voxels(whole.map()).known());
  }
  EXPECT_GE(waited, 5u);  // the first of them shows a wall before the camera
  EXPECT_LT(count_voxels(live.map()).known(), count_voxels(whole.map()).known());
  EXPECT_EQ(live.catch_up().waiting_voxels, 0u);
  EXPECT_TRUE(bytes_of(live.settled().get()) == bytes_of(whole.settled().get()));
}

TEST(LiveWindow, WhatIsSetComesAfterWhatWaitedForTheSameBlock) {
  LiveConfig config = house_config();
  config.window = 1.0;
  LiveRoadmap live(config);
  integrate(live, flight_through_house(1)[0]);
  LiveRoadmap other(config);
  integrate(other, flight_through_house(1)[0]);
  other.catch_up();
  std::vector<VoxelChange> set;
  for (const VoxelChange& known : testing::changes_to(other.map()))
    if (set.size() < 500) set.push_back({known.voxel, VoxelState::kOccupied});
  live.set_voxels(set);
  live.catch_up();
  other.set_voxels(set);
  EXPECT_TRUE(testing::changes_to(live.map()) == testing::changes_to(other.map()));
}

/// A corridor with a door that is closed for a while.
World corridor() {
  World world = make_house();
  world.boxes.clear();
  world.spheres.clear();
  world.cylinders.clear();
  TimedSolids door;
  door.from = 6.0;
  door.until = 14.0;
  door.boxes.push_back({.centre = {7.5, 5.5, 2.5}, .size = {0.6, 11.0, 6.0}});
  world.timed.push_back(door);
  return world;
}

TEST(LiveRoadmap, RefusesScansFarFromItsOrigin) {
  LiveConfig config = house_config();
  config.origin = VoxelIndex{-1'000'000'000, 0, 0};
  LiveRoadmap live(config);
  const std::vector<Point> points = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  EXPECT_NE(refusal([&] {
              live.integrate(points, Eigen::Isometry3d::Identity());
            }).find("farther than 5e8 voxels"),
            std::string::npos);
  EXPECT_EQ(live.snapshot(), nullptr);
  EXPECT_EQ(live.map().layout.block_count(), 0u);
}

/// Whether what it sees lies within the window or waits beyond.
TEST(LiveRoadmap, RefusesScansThatReachTooFarBeyondItsWindow) {
  for (const double window : {1.0, 100.0}) {
    LiveConfig config = house_config();
    config.window = window;
    config.origin = VoxelIndex{-500'000'000 + 10, 0, 0};
    LiveRoadmap live(config);
    const double far = 60.0 * config.fusion.voxel_size;
    const std::vector<Point> points = {{far, 0.0, 0.0}, {far, 0.1, 0.0}};
    EXPECT_NE(refusal([&] {
                live.integrate(points, Eigen::Isometry3d::Identity());
              }).find("farther than 5e8 voxels"),
              std::string::npos);
    live.catch_up();
    EXPECT_EQ(live.map().layout.block_count(), 0u);
  }
}

TEST(LiveRoadmap, OfAWorldThatChangesHasTheBytesOfABatchBuildAndForgets) {
  const World world = corridor();
  LiveConfig config = house_config();
  config.fusion.forget_after = 3;
  LiveRoadmap live(config);
  const auto door_is = [&] {
    const OccupancyMap map = live.map();
    return map.at(voxel_at({7.3, 5.5, 2.0}, config.fusion.voxel_size) - map.origin);
  };
  const Eigen::Isometry3d pose = level_pose({6.0, 5.5, 2.0}, 0.0);
  for (int time = 0; time < 20; ++time) {
    SCOPED_TRACE(time);
    integrate(live, {render_depth(world_at(world, time), sensor_of_flight(), pose,
                                  static_cast<std::uint64_t>(time)),
                     pose});
    EXPECT_TRUE(bytes_of(live.settled().get()) == batch_bytes(live.map(), config.build));
    if (time == 5 || time == 19) EXPECT_EQ(door_is(), VoxelState::kFree);
    if (time >= 6 + 3 - 1 && time < 14) EXPECT_EQ(door_is(), VoxelState::kOccupied);
    if (time >= 14 + 3 - 1) EXPECT_EQ(door_is(), VoxelState::kFree);
  }
}

TEST(ScanLog, IsOneRoadmapsAlone) {
  const TemporaryFolder folder;
  const LiveConfig config = with_log(folder);
  LiveRoadmap one(config);
  EXPECT_THROW(LiveRoadmap{config}, InputError);  // nothing was kept there yet
  integrate(one, flight_through_house(1)[0]);
}

}  // namespace
}  // namespace ridgeway
