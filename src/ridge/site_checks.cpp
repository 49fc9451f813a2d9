// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <atomic>

#include "esdf/site_limit.hpp"
#include "ridge_checks.hpp"
#include "ridgeway/common/parallel.hpp"
#include "skeleton/lanes.hpp"

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

/// One number for every voxel of a block.
using Plane = std::array<int, kBlockVoxels>;

/// A block's sites in a form for vector code.
struct BlockSites {
  std::array<Plane, 3> offset;  // by axis
  Plane distance;               // 4 d^2 / s^2, kNone without a site
};

/// The voxels of a block's face: their distances, and their sites' offsets along the face's axis.
struct Face {
  std::array<int, 64> distance, offset;
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

/// Calls body(voxel, its number in the face) for the voxels of a block's lowest layer along an
/// axis.
template <std::size_t axis, typename Body>
void for_each_of_face(const Body& body) {
  constexpr std::size_t kRow = axis == 0 ? 8 : 1, kColumn = axis == 2 ? 8 : 64;
  for (std::size_t column = 0; column < 8; ++column)
    for (std::size_t row = 0; row < 8; ++row) body(column * kColumn + row * kRow, column * 8 + row);
}

/// Checks what sites say of each other: a voxel is no farther from obstacles than from the site of
/// a neighbour. By induction from the obstacles, no distance can then be stretched.
class SiteChecks {
 public:
  explicit SiteChecks(const EsdfMap& esdf) : esdf_(esdf), longest_(longest_distance(esdf)) {}

  /// What is wrong with a block; nullptr for nothing.
  const char* look_at(std::uint32_t slot) const {
    const char* found = nullptr;
    detail::with_lanes([&](auto) { found = look_at_lanes(slot); });
    return found;
  }

 private:
  static constexpr const char* kContradiction =
      "has a distance that a neighbour's site contradicts";

  static int longest_distance(const EsdfMap& esdf) {
    return static_cast<int>(detail::largest_kept(esdf.max_distance / esdf.voxel_size));
  }

  const char* look_at_lanes(std::uint32_t slot) const {
    BlockSites sites;
    gather(esdf_, slot, sites);
    if (any_too_far(sites)) return "has a distance above max_distance";
    if (!(agree_within<0>(sites) && agree_within<1>(sites) && agree_within<2>(sites)))
      return kContradiction;
    if (!(agrees_across<0>(slot, sites) && agrees_across<1>(slot, sites) &&
          agrees_across<2>(slot, sites)))
      return kContradiction;
    return lead_to_obstacles(slot, sites) ? nullptr : "has an offset to what is no obstacle";
  }

  /// Whether a voxel at one distance may not stand beside one at another, whose site is one more
  /// voxel away by `more`. Who has no site has none within the longest distance.
  bool contradicts(int distance, int neighbour, int more) const {
    return std::min(distance, longest_ + 1) > neighbour + more;
  }

  /// The same of two neighbours, both ways: by their distances, and by their sites' offsets along
  /// the axis from the lower to the upper one.
  unsigned contradict(int lower, int lower_offset, int upper, int upper_offset) const {
    return static_cast<unsigned>(contradicts(lower, upper, growth(upper_offset))) |
           static_cast<unsigned>(contradicts(upper, lower, growth(-lower_offset)));
  }

  bool any_too_far(const BlockSites& sites) const {
    unsigned bad = 0;
    for (const int distance : sites.distance)
      bad |= static_cast<unsigned>((distance > longest_) & (distance != kNone));
    return bad != 0;
  }

  template <std::size_t axis>
  bool agree_within(const BlockSites& sites) const {
    constexpr unsigned kStep = kStride[axis];
    const Plane& offset = sites.offset[axis];
    const Plane& distance = sites.distance;
    unsigned bad = 0;
    for (unsigned i = 0; i < kBlockVoxels - kStep; ++i) {
      const unsigned has_next = (i / kStep & 7) != 7;
      bad |= has_next & contradict(distance[i], offset[i], distance[i + kStep], offset[i + kStep]);
    }
    return bad == 0;
  }

  /// The pairs across the two faces of a block that an axis goes through; the upper face's voxels
  /// are held against the neighbour's, both ways.
  template <std::size_t axis>
  bool agrees_across(std::uint32_t slot, const BlockSites& sites) const {
    constexpr std::array<int, 3> kUp = {14, 16, 22};  // directions of neighbour_block
    const std::uint32_t above = esdf_.layout.neighbour_block(slot, kUp[axis]);
    const bool is_edge_unknown =
        esdf_.unknown == UnknownPolicy::kObstacle && !(esdf_.planar && axis == 2);
    unsigned bad = 0;
    if (is_edge_unknown &&
        esdf_.layout.neighbour_block(slot, 26 - kUp[axis]) == BlockLayout::kNoBlock)
      for_each_of_face<axis>([&](std::size_t i, std::size_t) { bad |= sites.distance[i] > 1; });
    const Face own = upper_face<axis>(sites);
    if (above != BlockLayout::kNoBlock) {
      const Face next = lower_face<axis>(above);
      for (std::size_t k = 0; k < 64; ++k)
        bad |= contradict(own.distance[k], own.offset[k], next.distance[k], next.offset[k]);
    } else if (is_edge_unknown) {
      for (const int distance : own.distance) bad |= distance > 1;
    }
    return bad == 0;
  }

  template <std::size_t axis>
  static Face upper_face(const BlockSites& sites) {
    Face face;
    for_each_of_face<axis>([&](std::size_t i, std::size_t k) {
      face.distance[k] = sites.distance[i + 7 * kStride[axis]];
      face.offset[k] = sites.offset[axis][i + 7 * kStride[axis]];
    });
    return face;
  }

  template <std::size_t axis>
  Face lower_face(std::uint32_t slot) const {
    Face face;
    const std::uint32_t* const squared = esdf_.squared.block(slot);
    esdf_.site.visit([&](const auto& field) {
      const auto* const site = field.block(slot);
      for_each_of_face<axis>([&](std::size_t i, std::size_t k) {
        face.distance[k] = distance_of(squared[i]);
        face.offset[k] = part_of(site[i], axis);
      });
    });
    return face;
  }

  /// Whether every site is an obstacle. One that a voxel shares with the voxel below (in the lowest
  /// layer: before) has been looked at there.
  bool lead_to_obstacles(std::uint32_t slot, const BlockSites& sites) const {
    Plane own;
    own[0] = has_site(sites, 0);
    mark_own_sites<0>(sites, 1, 8, own);
    mark_own_sites<1>(sites, 8, 64, own);
    mark_own_sites<2>(sites, 64, kBlockVoxels, own);
    VoxelFinder finder(esdf_.layout);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if (own[i] == 0) continue;
      const VoxelIndex offset = {sites.offset[0][i], sites.offset[1][i], sites.offset[2][i]};
      const VoxelId id = slot * kBlockVoxels + static_cast<VoxelId>(i);
      if (!esdf_.is_obstacle(finder.find(esdf_.layout.index_of(id) + offset))) return false;
    }
    return true;
  }

  static int has_site(const BlockSites& sites, std::size_t i) {
    const int distance = sites.distance[i];
    return (distance != 0) & (distance != kNone);
  }

  /// For voxels from `first` to before `end`: 1 if they have another site than the voxel before
  /// them along an axis, otherwise 0.
  template <std::size_t axis>
  static void mark_own_sites(const BlockSites& sites, unsigned first, unsigned end, Plane& own) {
    const auto& [x, y, z] = sites.offset;
    for (unsigned i = first; i < end; ++i) {
      const unsigned before = i - static_cast<unsigned>(kStride[axis]);
      const int apart = (x[i] - x[before] + (axis == 0)) | (y[i] - y[before] + (axis == 1)) |
                        (z[i] - z[before] + (axis == 2));
      own[i] = has_site(sites, i) & ((apart != 0) | (sites.distance[before] == kNone));
    }
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
