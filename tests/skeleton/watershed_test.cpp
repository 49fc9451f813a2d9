// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "skeleton/watershed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "random_levels.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/cube_answers.hpp"
#include "skeleton/kernel_joiner.hpp"
#include "skeleton/plain_regions.hpp"
#include "skeleton/plain_watershed.hpp"
#include "skeleton/simple_point.hpp"
#include "skeleton/sub_field.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::Regions;
using detail::regions_at;

/// The peak to which a voxel's climb leads.
VoxelId plain_peak(const EsdfMap& esdf, const VoxelMask& traversable, VoxelId id) {
  for (;;) {
    const Direction climb = detail::plain_climb(esdf, traversable, id);
    if (climb == kCentre) return id;
    id = esdf.layout.neighbour(id, climb);
  }
}

void expect_to_be_what_every_voxel_sees(const EsdfMap& esdf, const VoxelMask& traversable) {
  const detail::Watershed watershed = detail::find_watershed(esdf, traversable);
  std::vector<detail::CriticalVoxel> critical;
  std::vector<VoxelId> peaks;
  for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
    if (!traversable.test(id)) {
      ASSERT_EQ(watershed.basins.next[id], kNotTraversable);
      ASSERT_FALSE(watershed.basins.not_simple_at_first_turn.test(id));
      continue;
    }
    const Cube27 higher = detail::plain_neighbours(
        esdf, traversable, id, [&](VoxelId n, int) { return detail::is_above(esdf, n, id); });
    const Cube27 later = detail::plain_neighbours(esdf, traversable, id, [&](VoxelId n, int) {
      return std::pair(esdf.squared[n], detail::sub_field(n)) >
             std::pair(esdf.squared[id], detail::sub_field(id));
    });
    ASSERT_EQ(watershed.basins.next[id], detail::plain_climb(esdf, traversable, id));
    ASSERT_EQ(watershed.basins.peaks[watershed.basins.basin[id]],
              plain_peak(esdf, traversable, id));
    ASSERT_EQ(watershed.basins.not_simple_at_first_turn.test(id), !is_simple(later));
    if (!detail::is_regular(higher)) critical.push_back({id, higher});
    if (watershed.basins.next[id] == kCentre) peaks.push_back(id);
  }
  ASSERT_EQ(watershed.critical, critical);
  ASSERT_EQ(watershed.basins.peaks, peaks);
}

/// Every voxel a peak: far more basins than any map's block has.
TEST(Watershed, NumbersAsManyBasinsAsABlockHasVoxels) {
  for (const VoxelId count : {1u, 2u, 3u, 4u, 5u, 16u, 17u, 256u, 257u, 512u}) {
    const BlockLayout layout({{0, 0, 0}});
    VoxelMask traversable(layout);
    for (VoxelId id = 0; id < count; ++id) traversable.set(id);
    const std::vector<Direction> next(kBlockVoxels, kCentre);
    BasinNumbers::InBlock found = detail::basins_in_block(traversable, 0, next.data(),
                                                          [](VoxelId id) { return 1000 + 3 * id; });
    ASSERT_EQ(found.basins.size(), count);
    if (count == 1) continue;  // one for the whole block
    const BasinNumbers numbers{{BasinNumbers::kSeveral}, {std::move(found)}};
    for (VoxelId id = 0; id < count; ++id) ASSERT_EQ(numbers[id], 1000 + 3 * id) << count;
  }
}

TEST(Watershed, OfBlocksIsWhatEveryVoxelSeesOfItsNeighbours) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const testing::RandomLevels levels = testing::random_levels(seed);
    expect_to_be_what_every_voxel_sees(levels.esdf, levels.traversable);
    if (HasFatalFailure()) return;
  }
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed, 26));
    expect_to_be_what_every_voxel_sees(esdf, traversable_voxels(esdf, 0.05));
    if (HasFatalFailure()) return;
  }
}

/// Lone obstacles at random in free space: many passes over diagonal moves.
OccupancyMap specks(unsigned seed) {
  std::mt19937 random(seed);
  const unsigned one_of = 6 + seed % 5 * 10;
  return testing::make_map(0.1, {0, 0, 0}, {15, 15, 11}, [&](const VoxelIndex&) {
    return random() % one_of == 0 ? VoxelState::kOccupied : VoxelState::kFree;
  });
}

TEST(Watershed, DynamicsAreThoseOfKruskalOverAllMoves) {
  std::size_t finite = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const EsdfMap esdf = compute_esdf(seed % 2 == 0 ? specks(seed) : testing::random_map(seed, 26),
                                      {.unknown = policy});
    const double radius = seed % 2 == 0 ? 0.05 : 0.05 * (1 + seed / 2 % 3);
    const VoxelMask traversable = traversable_voxels(esdf, radius);
    std::vector<double> dynamics = find_basins(esdf, traversable, radius).dynamics;
    std::erase(dynamics, 0.0);  // equally high parts of one plateau
    std::sort(dynamics.begin(), dynamics.end());
    const std::vector<double> plain =
        detail::plain_dynamics(esdf, traversable, least_clearance(radius, esdf.voxel_size));
    ASSERT_EQ(dynamics.size(), plain.size());
    for (std::size_t i = 0; i < dynamics.size(); ++i) {
      ASSERT_EQ(std::isinf(dynamics[i]), std::isinf(plain[i]));
      if (std::isinf(plain[i])) continue;
      ASSERT_NEAR(dynamics[i], plain[i], 1e-12);  // moves may be rounded otherwise the other way
      ++finite;
    }
  }
  EXPECT_GT(finite, 1000u);
}

/// Any voxels, few or many, joined: whether at every radius those that space connects are connected
/// along the diagram, by flooding.
TEST(KernelJoiner, ConnectsAtEveryClearanceWhatSpaceConnectsThere) {
  constexpr unsigned kWanted[] = {4, 16, 64, 256};  // of 4,096
  std::size_t pieces_found = 0, radii = 0, added = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const EsdfMap esdf = compute_esdf(testing::random_map(seed, 20), {.unknown = policy});
    const VoxelMask traversable = traversable_voxels(esdf, 0.05);
    std::mt19937 random(seed);
    VoxelMask wanted(esdf.layout);
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id)
      if (traversable.test(id) && random() % 4096 < kWanted[seed % 4]) wanted.set(id);
    Basins basins = find_basins(esdf, traversable, 0.05);
    const VoxelMask diagram = detail::join_kernel(detail::RememberedSpace(esdf, nullptr), wanted,
                                                  least_clearance(0.05, esdf.voxel_size), basins);
    for (double radius = 0.05; radius < 0.6; radius *= 1.12) {
      SCOPED_TRACE(std::to_string(seed) + " " + std::to_string(radius));
      const Regions space = regions_at(esdf, radius);
      const Regions pieces = regions_at(esdf, radius, &diagram);
      if (pieces.voxels.empty()) break;
      std::map<std::uint32_t, std::uint32_t> piece_of_region;
      for (const VoxelId id : pieces.voxels) {
        const std::uint32_t piece = pieces.label.at(id);
        ASSERT_EQ(piece_of_region.try_emplace(space.label.at(id), piece).first->second, piece);
      }
      pieces_found += pieces.first.size();
      ++radii;
    }
    for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
      ASSERT_TRUE(!wanted.test(id) || diagram.test(id));
    }
    added += diagram.count() - wanted.count();
  }
  EXPECT_GT(radii, 300u);
  EXPECT_GT(pieces_found, radii + 200);
  EXPECT_GT(added, 1000u);
}

}  // namespace
}  // namespace ridgeway
