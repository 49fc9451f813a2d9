// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "ridge/ridge_checks.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "support/synthetic_roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

/// Files that are whole in every byte but lie about where the nearest obstacle is.
class LyingSites : public ::testing::TestWithParam<UnknownPolicy> {
 protected:
  void SetUp() override {
    honest_ = synthetic_roadmap({.rooms_x = 2, .rooms_y = 1, .unknown = GetParam()});
    const EsdfMap& esdf = honest_.esdf;
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
      if (esdf.obstacle.test(id)) obstacles_.push_back(esdf.layout.index_of(id));
      if (esdf.squared[id] != 0 && esdf.squared[id] != kNoSite) live_.push_back(id);
    }
  }

  struct Outcome {
    bool refused = false;
    std::uint32_t longest_lie = 0;  ///< how much 4 d^2 / s^2 came out too large
  };

  Outcome outcome_of(const std::function<void(EsdfMap&)>& lie) const {
    Roadmap lying = honest_;
    lie(lying.esdf);
    save_roadmap(lying, folder_ / "lying.ridge");
    try {
      const Roadmap loaded = load_roadmap(folder_ / "lying.ridge");
      Outcome outcome;
      for (const VoxelId id : live_)
        if (loaded.esdf.squared[id] > honest_.esdf.squared[id])
          outcome.longest_lie =
              std::max(outcome.longest_lie, loaded.esdf.squared[id] - honest_.esdf.squared[id]);
      return outcome;
    } catch (const InputError& error) {
      return {.refused = std::string(error.what()).find("'site'") != std::string::npos};
    }
  }

  /// Makes a voxel name another as its site.
  void point(EsdfMap& esdf, VoxelId id, const VoxelIndex& site) const {
    const VoxelIndex o = site - esdf.layout.index_of(id);
    esdf.site.set(id, {static_cast<std::int16_t>(o.x), static_cast<std::int16_t>(o.y),
                       static_cast<std::int16_t>(o.z)});
    esdf.squared[id] = squared_halves(esdf.site[id]);
  }

  VoxelId any_live(std::mt19937& random) const { return live_[random() % live_.size()]; }

  Roadmap honest_;
  std::vector<VoxelIndex> obstacles_;
  std::vector<VoxelId> live_;
  TemporaryFolder folder_;
};

TEST_P(LyingSites, TheTruthIsLoaded) {
  const Outcome outcome = outcome_of([](EsdfMap&) {});
  EXPECT_FALSE(outcome.refused);
  EXPECT_EQ(outcome.longest_lie, 0u);
}

TEST_P(LyingSites, OneVoxelThatNamesAnotherObstacleIsRefusedOrNoFarther) {
  std::mt19937 random(6);
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    const VoxelId id = any_live(random);
    const Outcome outcome = outcome_of(
        [&](EsdfMap& esdf) { point(esdf, id, obstacles_[random() % obstacles_.size()]); });
    EXPECT_TRUE(outcome.refused || outcome.longest_lie == 0) << id;
    refused += outcome.refused;
  }
  EXPECT_GT(refused, 100);
}

TEST_P(LyingSites, AVoxelThatNamesFreeSpaceIsRefused) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const VoxelId id = any_live(random);
    EXPECT_TRUE(outcome_of([&](EsdfMap& esdf) {
                  VoxelId other = any_live(random);
                  while (other == id) other = any_live(random);
                  point(esdf, id, esdf.layout.index_of(other));
                }).refused);
  }
}

/// All agree with their neighbours, but nothing stands where they say.
TEST_P(LyingSites, ARegionThatAgreesOnAnObstacleThatIsNotThereIsRefused) {
  const VoxelIndex nowhere = honest_.esdf.layout.index_of(live_.front()) - VoxelIndex{0, 0, 12};
  const VoxelIndex inside = honest_.esdf.layout.index_of(live_[live_.size() / 2]);
  int lies = 0;
  for (const VoxelIndex& phantom : {inside, nowhere}) {
    const VoxelId target = honest_.esdf.layout.find(phantom);
    if (honest_.esdf.is_obstacle(target)) continue;  // unknown space is one
    Roadmap lying = honest_;
    for (const VoxelId id : live_)
      if (id != target) point(lying.esdf, id, phantom);
    const auto defect = find_site_defect(lying);
    ASSERT_TRUE(defect);
    EXPECT_EQ(defect->part, "site");
    ++lies;
  }
  EXPECT_GE(lies, 1);
}

/// A wall that half a room overlooks, as a file would have it that hides an obstacle.
TEST_P(LyingSites, ARegionThatOverlooksTheNearestObstaclesIsRefused) {
  std::mt19937 random(8);
  int refused = 0;
  for (int i = 0; i < 30; ++i) {
    const VoxelIndex chosen = obstacles_[random() % obstacles_.size()];
    std::size_t changed = 0;
    const Outcome outcome = outcome_of([&](EsdfMap& esdf) {
      for (const VoxelId id : live_) {
        const VoxelIndex o = chosen - esdf.layout.index_of(id);
        if (std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) > 9) continue;
        changed +=
            squared_halves(o.x) + squared_halves(o.y) + squared_halves(o.z) > esdf.squared[id];
        point(esdf, id, chosen);
      }
    });
    EXPECT_TRUE(outcome.refused || changed == 0) << chosen.x << "," << chosen.y << "," << chosen.z;
    refused += outcome.refused;
  }
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Policies, LyingSites,
                         ::testing::Values(UnknownPolicy::kObstacle, UnknownPolicy::kIgnore),
                         [](const auto& policy) {
                           return policy.param == UnknownPolicy::kObstacle ? "UnknownIsObstacle"
                                                                           : "UnknownIsIgnored";
                         });

/// The longest distances that agree with each other: handed on from obstacles to neighbours, each
/// voxel taking the nearest of the sites that its neighbours have.
void hand_on_sites(EsdfMap& esdf) {
  std::vector<VoxelId> front;
  for (VoxelId id = 0; id < esdf.squared.size(); ++id) {
    const bool solid = esdf.obstacle.test(id);
    esdf.squared[id] = solid ? 0 : kNoSite;
    esdf.site.set(id, {});
    if (solid) front.push_back(id);
  }
  while (!front.empty()) {
    std::vector<VoxelId> next;
    for (const VoxelId from : front)
      for (const int direction : {4, 10, 12, 14, 16, 22}) {
        const VoxelId to = esdf.layout.neighbour(from, direction);
        if (to == kNoVoxel) continue;
        const VoxelIndex step = offset_of(direction);
        const SiteOffset o = esdf.site[from];
        const SiteOffset site = {static_cast<std::int16_t>(o.x - step.x),
                                 static_cast<std::int16_t>(o.y - step.y),
                                 static_cast<std::int16_t>(o.z - step.z)};
        if (squared_halves(site) >= esdf.squared[to]) continue;
        esdf.squared[to] = squared_halves(site);
        esdf.site.set(to, site);
        next.push_back(to);
      }
    front = std::move(next);
  }
}

TEST(SitesThatAgree, AreWrongByLessThanHalfAVoxel) {
  double worst = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<BlockIndex> blocks;
    for (int i = 0; i < 64; ++i) blocks.push_back({i % 4, i / 4 % 4, i / 16});
    OccupancyMap map;
    map.voxel_size = 0.1;
    map.layout = BlockLayout(blocks);
    map.state = VoxelField<VoxelState>(map.layout, VoxelState::kFree);
    for (unsigned i = 0; i < 4 + 3 * seed; ++i)
      map.state[static_cast<VoxelId>(random() % map.state.size())] = VoxelState::kOccupied;
    Roadmap roadmap;
    roadmap.esdf = compute_esdf(map, {.unknown = UnknownPolicy::kIgnore});
    EXPECT_FALSE(find_site_defect(roadmap));
    const EsdfMap honest = roadmap.esdf;
    hand_on_sites(roadmap.esdf);
    EXPECT_FALSE(find_site_defect(roadmap));
    for (VoxelId id = 0; id < honest.squared.size(); ++id)
      worst = std::max(worst, (roadmap.esdf.distance(id) - honest.distance(id)) / 0.1);
  }
  EXPECT_GT(worst, 0.0);  // it does happen
  EXPECT_LT(worst, 0.5);
}

TEST(LyingSitesOfFarVoxels, AVoxelWithoutASiteBesideOneNearAnObstacleIsRefused) {
  const TemporaryFolder folder;
  Roadmap roadmap = synthetic_roadmap({.rooms_x = 1, .rooms_y = 1, .max_distance = 0.45});
  save_roadmap(roadmap, folder / "a.ridge");
  EXPECT_NO_THROW(load_roadmap(folder / "a.ridge"));
  std::mt19937 random(9);
  for (int i = 0; i < 20; ++i) {
    Roadmap lying = roadmap;
    VoxelId id = 0;
    do id = static_cast<VoxelId>(random() % roadmap.esdf.squared.size());
    while (roadmap.esdf.squared[id] == 0 || roadmap.esdf.squared[id] == kNoSite);
    lying.esdf.squared[id] = kNoSite;
    lying.esdf.site.set(id, {});
    save_roadmap(lying, folder / "a.ridge");
    EXPECT_THROW(load_roadmap(folder / "a.ridge"), InputError);
  }
}

}  // namespace
}  // namespace ridgeway
