// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/skeleton/gvd.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "block_ridges.hpp"
#include "common/require.hpp"
#include "esdf/known_radius.hpp"
#include "lanes.hpp"
#include "ridgeway/common/parallel.hpp"
#include "voxel/cube_gather.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

using detail::load_lanes;
using detail::Row;

constexpr std::size_t kGrain = 16;
constexpr int kEdgeNeighbours = 18;
constexpr std::size_t kEdgeBasisPoints = 3;

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
    const VoxelIndex o = offset_of(d);
    if (!esdf.is_open(q) || esdf.squared[q] == kNoSite || (esdf.planar && o.z != 0)) continue;
    const SiteOffset n = esdf.site[q];
    if (body(SiteOffset{static_cast<std::int16_t>(n.x + o.x), static_cast<std::int16_t>(n.y + o.y),
                        static_cast<std::int16_t>(n.z + o.z)}))
      return true;
  }
  return false;
}

/// Squared distance between two sites, voxels.
double apart_squared(const SiteOffset& v, const SiteOffset& w) {
  const double x = v.x - w.x, y = v.y - w.y, z = v.z - w.z;
  return x * x + y * y + z * z;
}

bool is_on_gvd(const EsdfMap& esdf, VoxelId id, double cosine, double least_squared) {
  if (esdf.squared[id] == kNoSite) return true;
  const SiteOffset v = esdf.site[id];
  return any_neighbour_site(esdf, id, [&](const SiteOffset& w) {
    return w != v && apart_squared(v, w) >= least_squared && diverge(v, w, cosine);
  });
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

/// Where the nearest sites of a block and its border lie, each seen from its own voxel; not numbers
/// where there is none, as in obstacles.
struct SiteGather {
  std::array<detail::Bordered<float>, 3> at;

  SiteGather(const EsdfMap& esdf, std::uint32_t slot) {
    esdf.site.visit([&](const auto& sites) { gather(esdf.layout, sites, slot); });
  }

 private:
  template <typename Offset>
  void gather(const BlockLayout& layout, const VoxelField<Offset>& sites, std::uint32_t slot) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    detail::for_each_bordered_row(layout, slot, [&](std::size_t place, VoxelId first, auto count) {
      for (std::size_t i = 0; i < count; ++i) {
        const SiteOffset site =
            first == kNoVoxel ? SiteOffset{} : sites[first + static_cast<VoxelId>(i)];
        at[0][place + i] = site == SiteOffset{} ? kNone : site.x;
        at[1][place + i] = site.y;
        at[2][place + i] = site.z;
      }
    });
  }
};

/// What single precision says of some voxels without a doubt.
template <int lanes>
struct Verdict {
  using Cubes = typename Row<lanes>::Cubes;
  Cubes off_ridge;  ///< the sites of all six neighbours are near or less than theta away
  Cubes on_ridge;   ///< that of one is far enough and more than theta away
};

/// One or the other is true of almost all voxels. Where unknown voxels have sites too, but no say,
/// they may raise a doubt (`all_count`: there are none).
template <int lanes>
[[gnu::always_inline]] inline Verdict<lanes> judge(const SiteGather& sites, std::size_t first,
                                                   double cosine, double least_squared,
                                                   bool all_count) {
  using Cubes = typename Row<lanes>::Cubes;
  using Floats = typename Row<lanes>::Floats;
  Floats v[3], vv{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    v[axis] = load_lanes<Floats>(&sites.at[axis][first]);
    vv += v[axis] * v[axis];
  }
  constexpr double kDoubt = 1e-5;  // far above float rounding
  const auto least = static_cast<float>(std::max(cosine, 0.0) + kDoubt);
  const auto most = static_cast<float>(all_count ? std::max(cosine - kDoubt, 0.0) : 0.0);
  const Floats off_limit = vv * (least * least), on_limit = vv * (most * most);
  Verdict<lanes> verdict{~Cubes{}, Cubes{}};
  for (const Direction d : kFaceDirections) {
    const VoxelIndex o = offset_of(d);
    const std::array<int, 3> step{o.x, o.y, o.z};
    Floats dot{}, ww{}, apart{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats w = load_lanes<Floats>(&sites.at[axis][first] + detail::bordered_step(d)) +
                       static_cast<float>(step[axis]);
      dot += v[axis] * w;
      ww += w * w;
      apart += (v[axis] - w) * (v[axis] - w);
    }
    // Sites are whole voxels apart: what is rounded up is as much without a doubt.
    const auto are_near = apart < static_cast<float>(std::ceil(least_squared));
    const Floats squared = dot * dot;
    const auto diverge_little = (dot > 0.0f) & (squared >= off_limit * ww);
    const auto diverge_much = (squared < on_limit * ww) | ((dot < 0.0f) & (on_limit > 0.0f));
    verdict.off_ridge &= reinterpret_cast<Cubes>(diverge_little | are_near);
    verdict.on_ridge |= reinterpret_cast<Cubes>(diverge_much & ~are_near);
  }
  return verdict;
}

void set(VoxelMask::Block& block, VoxelId id) { block[id / 64 % kBlockSide] |= 1ull << id % 64; }

/// A mask made block by block.
template <typename BlockOf>
VoxelMask mask_by_block(const BlockLayout& layout, const BlockOf& block_of_slot) {
  VoxelMask mask(layout);
  parallel_for_each_index(
      layout.block_count(),
      [&](std::size_t index) {
        const auto slot = static_cast<std::uint32_t>(index);
        const VoxelMask::Block block = block_of_slot(slot);
        if (!detail::is_empty(block)) mask.block(slot) = block;
      },
      kGrain);
  return mask;
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

VoxelMask traversable_voxels(const EsdfMap& esdf, double radius, bool within_limits) {
  assert(esdf.state.is_of(esdf.layout) && esdf.squared.is_of(esdf.layout));
  detail::require(radius >= 0.0 && std::isfinite(radius), "radius", radius,
                  "give the robot's radius in metres, 0 or more");
  detail::require_known_distance(esdf, radius);
  return mask_by_block(esdf.layout, [&](std::uint32_t slot) {
    return detail::traversable_in_block(esdf, radius, slot, within_limits);
  });
}

void GvdConfig::validate() const {
  detail::require(theta > 0.0 && theta < 3.1416, "theta", theta,
                  "give an angle in radians in (0, pi)");
  detail::require(least_apart >= 0.0 && std::isfinite(least_apart), "least_apart", least_apart,
                  "give metres, 0 or more");
}

VoxelMask compute_gvd(const EsdfMap& esdf, const VoxelMask& traversable, const GvdConfig& config) {
  config.validate();
  assert(traversable.is_of(esdf.layout) && esdf.site.is_of(esdf.layout));
  return mask_by_block(esdf.layout, [&](std::uint32_t slot) {
    return detail::gvd_in_block(esdf, traversable, config, slot);
  });
}

VoxelMask extract_basis_point_edges(const EsdfMap& esdf, const VoxelMask& gvd,
                                    const GvdConfig& config) {
  config.validate();
  const double cosine = std::cos(config.theta);
  return filter(esdf.layout, gvd,
                [&](VoxelId id) { return has_basis_points(esdf, id, cosine, kEdgeBasisPoints); });
}

VoxelMask extract_edges(const EsdfMap& esdf, const VoxelMask& gvd) {
  return mask_by_block(esdf.layout, [&](std::uint32_t slot) {
    return detail::edges_in_block(esdf.layout, gvd, slot);
  });
}

namespace detail {
namespace {

void keep_within_limits(const EsdfMap& esdf, std::uint32_t slot, VoxelMask::Block& block) {
  for (int v = 0; v < kBlockVoxels; ++v)
    if (const VoxelIndex voxel = voxel_of(esdf.layout.block(slot), v);
        !esdf.limits.allow_voxel(voxel, esdf.voxel_size))
      block[static_cast<std::size_t>(v / 64)] &= ~(1ull << v % 64);
}

}  // namespace

VoxelMask::Block traversable_in_block(const EsdfMap& esdf, double radius, std::uint32_t slot,
                                      bool within_limits) {
  const double threshold = std::ceil(least_clearance(radius, esdf.voxel_size).value);
  if (threshold > kNoSite) return {};
  const auto least = static_cast<std::uint32_t>(threshold);
  const VoxelState* state = esdf.state.block(slot);
  const std::uint32_t* squared = esdf.squared.block(slot);
  const UnknownPolicy unknown = esdf.unknown;
  VoxelMask::Block block =
      block_where([&](int v) { return is_open(state[v], unknown) & (squared[v] >= least); });
  if (within_limits && esdf.limits.any()) keep_within_limits(esdf, slot, block);
  if (!within_limits && esdf.planar)  // which has no other layers, whatever its limits
    for (std::size_t layer = 0; layer < block.size(); ++layer)
      if (layer != static_cast<std::size_t>(kPlanarLayer)) block[layer] = 0;
  return block;
}

VoxelMask::Block gvd_in_block(const EsdfMap& esdf, const VoxelMask& traversable,
                              const GvdConfig& config, std::uint32_t slot) {
  VoxelMask::Block gvd{};
  if (detail::is_empty(traversable.block(slot))) return gvd;
  const double cosine = std::cos(config.theta);
  const double least = config.least_apart * (1.0 - 1e-9) / esdf.voxel_size;
  const bool all_count = esdf.unknown == UnknownPolicy::kObstacle && !esdf.planar;
  const SiteGather sites(esdf, slot);
  with_lanes([&]<int lanes>(LaneCount<lanes>) {
    for_each_row_of<lanes>(traversable, slot, [&](VoxelId first, unsigned members) {
      const auto verdict =
          judge<lanes>(sites, bordered_place(first), cosine, least * least, all_count);
      for (; members != 0; members &= members - 1) {
        const auto x = static_cast<VoxelId>(std::countr_zero(members));
        if (verdict.off_ridge[x]) continue;
        if (verdict.on_ridge[x] || is_on_gvd(esdf, first + x, cosine, least * least))
          set(gvd, first + x);
      }
    });
  });
  return gvd;
}

VoxelMask::Block edges_in_block(const BlockLayout& layout, const VoxelMask& gvd,
                                std::uint32_t slot) {
  VoxelMask::Block edges{};
  if (detail::is_empty(gvd.block(slot))) return edges;
  const CubeGather gather(layout, gvd, slot);
  for_each_member(gvd, slot, [&](VoxelId id) {
    if (bit_count(gather.cube(id) & kCells26) >= kEdgeNeighbours) set(edges, id);
  });
  return edges;
}

}  // namespace detail

}  // namespace ridgeway
