// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/gvd.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ridgeway/common/parallel.hpp"
#include "ridgeway/voxel/cube_gather.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kGrain = 16;
constexpr int kEdgeNeighbours = 18;
constexpr std::size_t kEdgeBasisPoints = 3;

VoxelId first_of(std::size_t slot) { return static_cast<VoxelId>(slot * kBlockVoxels); }

/// Whether the angle between two directions exceeds theta; false where one of them is zero.
bool diverge(const SiteOffset& v, const SiteOffset& w, double cosine) {
  const double vv = v.x * v.x + v.y * v.y + v.z * v.z;
  const double ww = w.x * w.x + w.y * w.y + w.z * w.z;
  if (vv == 0.0 || ww == 0.0) return false;
  const double dot = v.x * w.x + v.y * w.y + v.z * w.z;
  return dot < cosine * std::sqrt(vv * ww);
}

/// Calls body(direction) with where the sites of the free 6-neighbours lie, seen from a voxel,
/// until it returns true; whether it did.
template <typename Body>
bool any_neighbour_site(const EsdfMap& esdf, VoxelId id, const Body& body) {
  for (const Direction d : kFaceDirections) {
    const VoxelId q = esdf.layout.neighbour(id, d);
    if (q == kNoVoxel || esdf.state[q] != VoxelState::kFree || esdf.squared[q] == kNoSite) continue;
    const VoxelIndex o = offset_of(d);
    const SiteOffset n = esdf.site[q];
    if (body(SiteOffset{static_cast<std::int16_t>(n.x + o.x), static_cast<std::int16_t>(n.y + o.y),
                        static_cast<std::int16_t>(n.z + o.z)}))
      return true;
  }
  return false;
}

bool is_on_gvd(const EsdfMap& esdf, VoxelId id, double cosine) {
  if (esdf.squared[id] == kNoSite) return true;
  const SiteOffset v = esdf.site[id];
  return any_neighbour_site(esdf, id,
                            [&](const SiteOffset& w) { return w != v && diverge(v, w, cosine); });
}

/// Whether a voxel has `least` basis points or more, at most 7.
bool has_basis_points(const EsdfMap& esdf, VoxelId id, double cosine, std::size_t least) {
  if (esdf.squared[id] == kNoSite) return true;
  std::array<SiteOffset, 7> basis{esdf.site[id]};
  std::size_t count = 1;
  return any_neighbour_site(esdf, id, [&](const SiteOffset& w) {
    const bool is_new = std::all_of(basis.begin(), basis.begin() + count,
                                    [&](const SiteOffset& v) { return diverge(v, w, cosine); });
    if (is_new) basis[count++] = w;
    return count >= least;
  });
}

/// Those voxels of a mask for which keep(voxel) holds.
template <typename Keep>
VoxelMask filter(const BlockLayout& layout, const VoxelMask& mask, const Keep& keep) {
  VoxelMask kept(layout);
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t index) {
        const auto slot = static_cast<std::uint32_t>(index);
        for_each_member(mask, slot, [&](VoxelId id) {
          if (keep(id)) kept.set(id);
        });
      },
      kGrain);
  return kept;
}

}  // namespace

VoxelMask traversable_voxels(const EsdfMap& esdf, double radius) {
  const double threshold = squared_threshold(radius, esdf.voxel_size);
  VoxelMask result(esdf.layout);
  parallel_for_each_index(
      esdf.layout.block_count(),
      [&](std::size_t slot) {
        const VoxelId first = first_of(slot);
        for (VoxelId id = first; id < first + kBlockVoxels; ++id)
          if (esdf.state[id] == VoxelState::kFree && esdf.squared[id] >= threshold) result.set(id);
      },
      kGrain);
  return result;
}

VoxelMask compute_gvd(const EsdfMap& esdf, const VoxelMask& traversable, const GvdConfig& config) {
  const double cosine = std::cos(config.theta);
  return filter(esdf.layout, traversable, [&](VoxelId id) { return is_on_gvd(esdf, id, cosine); });
}

VoxelMask extract_basis_point_edges(const EsdfMap& esdf, const VoxelMask& gvd,
                                    const GvdConfig& config) {
  const double cosine = std::cos(config.theta);
  return filter(esdf.layout, gvd,
                [&](VoxelId id) { return has_basis_points(esdf, id, cosine, kEdgeBasisPoints); });
}

VoxelMask extract_edges(const EsdfMap& esdf, const VoxelMask& gvd) {
  VoxelMask edges(esdf.layout);
  parallel_for_each_index(
      esdf.layout.block_count(),
      [&](std::size_t slot) {
        if (gvd.block(static_cast<std::uint32_t>(slot)) == VoxelMask::Block{}) return;
        const CubeGather gather(esdf.layout, gvd, static_cast<std::uint32_t>(slot));
        for_each_member(gvd, static_cast<std::uint32_t>(slot), [&](VoxelId id) {
          if (std::popcount(gather.cube(id) & kCells26) >= kEdgeNeighbours) edges.set(id);
        });
      },
      kGrain);
  return edges;
}

}  // namespace ridgeway
