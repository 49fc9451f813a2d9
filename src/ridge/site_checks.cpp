// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <atomic>

#include "ridge_checks.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway {
namespace {

/// Stands for the distance of a voxel without a site: above all that there are, and far enough from
/// the end of its type that a step more does not reach it.
constexpr int kNone = 1 << 30;

/// How much 4 d^2 / s^2 grows by when an offset grows by one along an axis: the difference of
/// squared_halves(k + 1) and squared_halves(k). No branches: loops over it become vector code.
constexpr int growth(int k) {
  return 8 * (k > 0 ? k : 0) + 8 * (k < -1 ? k + 1 : 0) + (k == 0) - (k == -1);
}
static_assert(growth(0) == 1 && growth(1) == 8 && growth(-1) == -1 && growth(-3) == -16);

constexpr std::array<std::size_t, 3> kStride = {1, 8, 64};

/// One number for every voxel of a block, with room behind for a look one layer too far.
using Plane = std::array<int, kBlockVoxels + 64>;

/// A block's sites in a form for vector code.
struct BlockSites {
  std::array<Plane, 3> offset;  // by axis
  Plane distance;               // 4 d^2 / s^2, kNone without a site
};

/// A stored distance as a number that may grow by a step; too long ones stay too long.
int distance_of(std::uint32_t squared) {
  constexpr std::uint32_t most = kNone - 1;
  return squared == kNoSite ? kNone : static_cast<int>(std::min(squared, most));
}

int part_of(const SiteOffset& site, std::size_t axis) {
  return axis == 0 ? site.x : axis == 1 ? site.y : site.z;
}

void gather(const EsdfMap& esdf, std::uint32_t slot, BlockSites& sites) {
  esdf.site.visit([&](const auto& field) {
    const auto* const site = field.block(slot);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const SiteOffset offset = site[i];
      sites.offset[0][i] = offset.x;
      sites.offset[1][i] = offset.y;
      sites.offset[2][i] = offset.z;
    }
  });
  const std::uint32_t* const squared = esdf.squared.block(slot);
  for (std::size_t i = 0; i < kBlockVoxels; ++i) sites.distance[i] = distance_of(squared[i]);
}

/// Checks what sites say of each other: a voxel is no farther from obstacles than from the site of
/// a neighbour. By induction from the obstacles, no distance can then be stretched.
class SiteChecks {
 public:
  explicit SiteChecks(const EsdfMap& esdf) : esdf_(esdf), longest_(longest_distance(esdf)) {}

  /// What is wrong with a block; nullptr for nothing.
  const char* look_at(std::uint32_t slot) const {
    BlockSites sites{};
    gather(esdf_, slot, sites);
    if (any_too_far(sites)) return "has a distance above max_distance";
    if (!agree_within(sites)) return kContradiction;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!agrees_across(slot, axis, sites)) return kContradiction;
    return lead_to_obstacles(slot, sites) ? nullptr : "has an offset to what is no obstacle";
  }

 private:
  static constexpr const char* kContradiction =
      "has a distance that a neighbour's site contradicts";

  static int longest_distance(const EsdfMap& esdf) {
    const double reach =
        std::min(esdf.max_distance / esdf.voxel_size, static_cast<double>(kFarthestSite));
    return static_cast<int>(least_clearance(reach, 1.0).value * (1.0 + 4e-9));
  }

  /// Whether a voxel at one distance may stand beside one at another, whose site is one more voxel
  /// away by `more`. Who has no site has none within the longest distance.
  bool may_be(int distance, int neighbour, int more) const {
    return std::min(distance, longest_ + 1) <= neighbour + more;
  }

  bool any_too_far(const BlockSites& sites) const {
    unsigned bad = 0;
    for (const int distance : sites.distance)
      bad |= static_cast<unsigned>((distance > longest_) & (distance != kNone));
    return bad != 0;
  }

  bool agree_within(const BlockSites& sites) const {
    unsigned bad = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t stride = kStride[axis];
      const Plane& offset = sites.offset[axis];
      const Plane& distance = sites.distance;
      for (std::size_t i = 0; i < kBlockVoxels - stride; ++i) {
        const unsigned has_next = (i / stride & 7) != 7;
        const bool low = may_be(distance[i], distance[i + stride], growth(offset[i + stride]));
        const bool high = may_be(distance[i + stride], distance[i], growth(-offset[i]));
        bad |= has_next & static_cast<unsigned>(!low | !high);
      }
    }
    return bad == 0;
  }

  /// The pairs across the two faces of a block that an axis goes through; the upper face's voxels
  /// are held against the neighbour's, both ways.
  bool agrees_across(std::uint32_t slot, std::size_t axis, const BlockSites& sites) const {
    constexpr std::array<int, 3> kUp = {14, 16, 22};  // directions of neighbour_block
    const std::size_t stride = kStride[axis];
    const std::uint32_t above = esdf_.layout.neighbour_block(slot, kUp[axis]);
    const bool open_below =
        esdf_.unknown != UnknownPolicy::kObstacle || (esdf_.planar && axis == 2) ||
        esdf_.layout.neighbour_block(slot, 26 - kUp[axis]) != BlockLayout::kNoBlock;
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if ((i / stride & 7) != 0) continue;
      const std::size_t top = i + 7 * stride;
      if (!open_below && sites.distance[i] > 1) return false;
      if (above != BlockLayout::kNoBlock) {
        const VoxelId next = above * kBlockVoxels + static_cast<VoxelId>(i);
        const int distance = distance_of(esdf_.squared[next]);
        if (!may_be(sites.distance[top], distance, growth(part_of(esdf_.site[next], axis))) ||
            !may_be(distance, sites.distance[top], growth(-sites.offset[axis][top])))
          return false;
      } else if (esdf_.unknown == UnknownPolicy::kObstacle && !(esdf_.planar && axis == 2) &&
                 sites.distance[top] > 1) {
        return false;
      }
    }
    return true;
  }

  /// Whether every site is an obstacle. One that a voxel shares with the voxel below (in the lowest
  /// layer: before) has been looked at there.
  bool lead_to_obstacles(std::uint32_t slot, const BlockSites& sites) const {
    const auto& [x, y, z] = sites.offset;
    const VoxelId first = slot * kBlockVoxels;
    VoxelFinder finder(esdf_.layout);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if (sites.distance[i] == 0 || sites.distance[i] == kNone) continue;
      const std::size_t axis = i >= 64 ? 2 : i >= 8 ? 1 : 0;
      if (i > 0) {
        const std::size_t before = i - kStride[axis];
        const bool is_same = (x[i] - x[before] + (axis == 0)) == 0 &&
                             (y[i] - y[before] + (axis == 1)) == 0 &&
                             (z[i] - z[before] + (axis == 2)) == 0;
        if (is_same && sites.distance[before] != kNone) continue;
      }
      const VoxelIndex site =
          esdf_.layout.index_of(first + static_cast<VoxelId>(i)) + VoxelIndex{x[i], y[i], z[i]};
      if (!esdf_.is_obstacle(finder.find(site))) return false;
    }
    return true;
  }

  const EsdfMap& esdf_;
  const int longest_;
};

}  // namespace

std::optional<RoadmapDefect> find_site_defect(const Roadmap& roadmap) {
  const SiteChecks checks(roadmap.esdf);
  std::atomic<const char*> found = nullptr;
  parallel_for_each_index(
      roadmap.esdf.layout.block_count(),
      [&](std::size_t slot) {
        if (found.load(std::memory_order_relaxed) != nullptr) return;
        if (const char* what = checks.look_at(static_cast<std::uint32_t>(slot))) found = what;
      },
      16);
  if (const char* what = found) return RoadmapDefect{"site", what};
  return {};
}

}  // namespace ridgeway
