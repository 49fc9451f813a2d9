// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "roadmap/attach_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "ridgeway/common/error.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/places.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using detail::AttachWay;
using detail::follow_attach;

/// The way of a voxel with the clearance of every move measured.
AttachWay plain_way(const Roadmap& roadmap, VoxelId from, double radius) {
  const EsdfMap& esdf = roadmap.esdf;
  const FreeSpace space(esdf);
  const SquaredHalves threshold = least_clearance(radius, esdf.voxel_size);
  SquaredHalves narrowest(std::numeric_limits<double>::infinity());
  AttachWay way;
  for (VoxelId id = from;;) {
    way.voxels.push_back(id);
    way.met_diagram |= roadmap.diagram.voxels.test(id);
    const Direction next = roadmap.attach.next[id];
    if (next == AttachField::kHere)
      way.vertex = detail::vertex_at(roadmap.graph, esdf.layout.index_of(id));
    if (next == AttachField::kHere || next == AttachField::kNotTraversable) break;
    const VoxelId to = esdf.layout.neighbour(id, next);
    if (to == kNoVoxel) break;
    const SquaredHalves clearance = space.move_clearance(id, to, next);
    if (clearance < threshold) break;
    narrowest = std::min(narrowest, clearance);
    id = to;
  }
  way.clearance = narrowest.metres(esdf.voxel_size);
  return way;
}

void expect_same(const AttachWay& way, const AttachWay& plain) {
  ASSERT_EQ(way.voxels, plain.voxels);
  ASSERT_EQ(way.vertex, plain.vertex);
  ASSERT_EQ(way.met_diagram, plain.met_diagram);
  ASSERT_EQ(way.clearance, plain.clearance);
}

TEST(AttachWay, IsThatOfEveryMoveMeasured) {
  std::size_t ways = 0, stopped = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::optional<Roadmap> roadmap;
    try {
      roadmap = build_roadmap(testing::random_map(seed, 40), {.min_clearance = 0.1}).roadmap;
    } catch (const InputError&) {
      continue;  // no room in this one
    }
    const std::vector<VoxelId> places = testing::traversable_places(roadmap->esdf, 0.1);
    for (const double radius : {0.1, 0.25}) {
      for (std::size_t i = 0; i < places.size(); i += 7) {
        const AttachWay plain = plain_way(*roadmap, places[i], radius);
        expect_same(follow_attach(*roadmap, places[i], radius), plain);
        const VoxelId other = places[i * 7919 % places.size()];
        const auto both = follow_attach(*roadmap, std::array{places[i], other}, radius);
        expect_same(both[0], plain);
        expect_same(both[1], plain_way(*roadmap, other, radius));
        if (HasFatalFailure()) return;
        plain.reached() ? ++ways : ++stopped;
      }
    }
  }
  EXPECT_GT(ways, 1000u);
  EXPECT_GT(stopped, 10u);
}

}  // namespace
}  // namespace ridgeway
