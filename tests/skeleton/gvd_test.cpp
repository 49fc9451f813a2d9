// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/gvd.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"

namespace ridgeway {
namespace {

using testing::make_map;
using testing::random_map;

Eigen::Vector3d to_site(const EsdfMap& esdf, const VoxelIndex& from, const VoxelIndex& of) {
  const SiteOffset o = esdf.site[esdf.layout.find(of)];
  const VoxelIndex d = of + VoxelIndex{o.x, o.y, o.z} - from;
  return Eigen::Vector3d(d.x, d.y, d.z);
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Sites of a voxel and its free 6-neighbours that part by more than theta, its own first.
std::vector<Eigen::Vector3d> basis_points(const EsdfMap& esdf, VoxelId id, double theta,
                                          double least_apart = 0.0) {
  const VoxelIndex v = esdf.layout.index_of(id);
  std::vector<Eigen::Vector3d> basis = {to_site(esdf, v, v)};
  for (const Direction d : kFaceDirections) {
    const VoxelId q = esdf.layout.find(v + offset_of(d));
    if (q == kNoVoxel || !esdf.is_open(q) || esdf.squared[q] == kNoSite) continue;
    const Eigen::Vector3d w = to_site(esdf, v, v + offset_of(d));
    bool is_new = w.norm() > 0.0 && (w - basis[0]).norm() >= least_apart - 1e-9;
    for (const Eigen::Vector3d& b : basis) is_new &= angle(b, w) > theta;
    if (is_new) basis.push_back(w);
  }
  return basis;
}

TEST(Gvd, AndEdgesAreWhatTheirDefinitionsSay) {
  std::size_t ridges = 0, thick = 0, three = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const auto policy = static_cast<UnknownPolicy>(seed % 3);
    const double max_distance = seed % 4 == 1 ? 0.25 : std::numeric_limits<double>::infinity();
    const EsdfMap esdf = compute_esdf(random_map(seed, 22), {policy, max_distance});
    const VoxelMask traversable = traversable_voxels(esdf, 0.1);
    for (const double theta : {0.3, 0.785, 1.3, 2.0}) {
      const VoxelMask gvd = compute_gvd(esdf, traversable, {theta});
      const VoxelMask edges = extract_edges(esdf, gvd);
      // Of a voxel's own site alone: those of its neighbours may be as near to each other.
      const double least_apart = 1.0 + static_cast<double>(seed % 5);  // voxels
      const VoxelMask apart = compute_gvd(esdf, traversable, {theta, least_apart * 0.1});
      const VoxelMask basis_edges = extract_basis_point_edges(esdf, gvd, {theta});
      for (VoxelId id = 0; id < esdf.layout.voxel_count(); ++id) {
        const bool open = esdf.is_open(id) && esdf.distance(id) >= 0.1 - 1e-9;
        ASSERT_EQ(traversable.test(id), open);
        const bool has_site = esdf.squared[id] != kNoSite;
        const std::size_t basis = open && has_site ? basis_points(esdf, id, theta).size()
                                  : open           ? 7
                                                   : 0;
        ASSERT_EQ(gvd.test(id), basis >= 2);
        ASSERT_EQ(apart.test(id),
                  open && (!has_site || basis_points(esdf, id, theta, least_apart).size() >= 2));
        int beside = 0;
        for (int d = 0; d < 27; ++d) {
          const VoxelId n = d == kCentre ? kNoVoxel : esdf.layout.neighbour(id, d);
          beside += n != kNoVoxel && gvd.test(n);
        }
        ASSERT_EQ(edges.test(id), gvd.test(id) && beside >= 18);
        ASSERT_EQ(basis_edges.test(id), basis >= 3);
      }
      ridges += gvd.count();
      thick += edges.count();
      three += basis_edges.count();
    }
  }
  EXPECT_GT(ridges, 10000u);
  EXPECT_GT(thick, 1000u);
  EXPECT_GT(three, 1000u);
}

/// A duct of 12 x 12 voxels, 60 long: its edges are its middle line.
OccupancyMap duct() {
  return make_map(0.1, {-1, -1, -1}, {60, 12, 12}, [](const VoxelIndex& v) {
    const bool inside = v.x >= 0 && v.x < 60 && v.y >= 0 && v.y < 12 && v.z >= 0 && v.z < 12;
    return inside ? VoxelState::kFree : VoxelState::kOccupied;
  });
}

TEST(Gvd, BasisPointEdgesOfADuctAreItsMiddleLine) {
  const EsdfMap esdf = compute_esdf(duct(), {});
  const VoxelMask gvd = compute_gvd(esdf, traversable_voxels(esdf, 0.2));
  const VoxelMask edges = extract_basis_point_edges(esdf, gvd);
  for (int x = 10; x < 50; ++x) {
    int on_line = 0;
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 12; ++z) {
        const bool middle = std::abs(y - 5.5) < 1.0 && std::abs(z - 5.5) < 1.0;
        const bool is_edge = edges.test(esdf.layout.find({x, y, z}));
        EXPECT_TRUE(middle || !is_edge) << x << " " << y << " " << z;
        on_line += is_edge;
      }
    EXPECT_GT(on_line, 0) << x;
  }
}

TEST(Gvd, BothEdgeRulesGiveAConnectedRoadmap) {
  for (const bool basis_point_edges : {false, true}) {
    const BuildResult built =
        build_roadmap(duct(), {.min_clearance = 0.2, .basis_point_edges = basis_point_edges});
    EXPECT_EQ(built.report.graph_components, 1u);
    EXPECT_GE(built.roadmap.graph.edges.size(), 1u);
  }
}

}  // namespace
}  // namespace ridgeway
