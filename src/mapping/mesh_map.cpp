// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mesh_map.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "common/number_text.hpp"
#include "memory_limit.hpp"
#include "mesh_leak.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "space_flood.hpp"
#include "touched_voxels.hpp"

namespace ridgeway {
namespace {

/// "12.5 x 4 x 2.75".
std::string size_text(const Box& box) {
  std::ostringstream text;
  const Eigen::Vector3d size = box.max - box.min;
  text << std::setprecision(4) << size.x() << " x " << size.y() << " x " << size.z();
  return text.str();
}

constexpr const char* kRepair = "repair it, or write it again";

std::string place_text(const Point& p) {
  return number_text(p.x()) + "," + number_text(p.y()) + "," + number_text(p.z());
}

/// Those voxels of masks that lie in a range.
void write_states(const BlockMasks& masks, VoxelState state, const VoxelRange& kept,
                  OccupancyMap& map) {
  parallel_for_each_index(masks.blocks.size(), [&](std::size_t i) {
    VoxelState* const states = map.state.block(map.layout.find_block(masks.blocks[i]));
    for (int local = 0; local < kBlockVoxels; ++local) {
      const std::uint64_t layer = masks.voxels[i][static_cast<std::size_t>(local >> 6)];
      if ((layer >> (local & 63) & 1) != 0 && kept.contains(voxel_of(masks.blocks[i], local)))
        states[local] = state;
    }
  });
}

/// Where to spread from, and what that is.
class FreeSpace {
 public:
  /// `range` is counted from the lattice's voxel `origin`.
  FreeSpace(const BlockMasks& walls, const VoxelRange& range, const VoxelIndex& origin,
            const MeshMapConfig& config, const std::string& name)
      : walls_(walls), range_(range), origin_(origin), config_(config), name_(name) {}

  SpaceFlood find(MeshMapReport& report) {
    if (!config_.inside.empty()) return from_places(report);
    SpaceFlood around = flood();
    const std::uint64_t outside = around.spread_from_sides();
    SpaceFlood all = flood();
    all.spread_from_sides();
    std::uint64_t most = 0;
    VoxelIndex largest;
    while (const auto voxel = all.find_unreached()) {
      const std::uint64_t count = all.spread_from(*voxel);
      ++report.enclosed;
      if (count > most) largest = *voxel;
      most = std::max(most, count);
    }
    report.largest_enclosed = static_cast<double>(most) * std::pow(config_.voxel_size, 3);
    report.in_largest = centre_of(origin_ + largest, config_.voxel_size);
    if (most <= outside) return around;
    report.free = MeshMapReport::Free::kWithin;
    --report.enclosed;
    SpaceFlood within = flood();
    within.spread_from(largest);
    return within;
  }

 private:
  SpaceFlood flood() const { return {walls_, range_, name_}; }

  SpaceFlood from_places(MeshMapReport& report) const {
    report.free = MeshMapReport::Free::kSeeded;
    SpaceFlood reached = flood();
    for (const Point& place : config_.inside) {
      const bool is_near = has_voxel(place, config_.voxel_size);
      const VoxelIndex voxel =
          is_near ? voxel_at(place, config_.voxel_size) - origin_ : VoxelIndex{};
      if (!is_near || !range_.contains(voxel))
        throw InputError("inside " + place_text(place), "lies outside the bounds of " + name_,
                         "give a place within " + place_text(report.box.min) + " to " +
                             place_text(report.box.max) + ", or larger bounds");
      if (!reached.is_open(voxel))
        throw InputError("inside " + place_text(place), "lies in a voxel that the surface touches",
                         "give a place in open space, or a smaller voxel_size");
      reached.spread_from(voxel);
    }
    return reached;
  }

  const BlockMasks& walls_;
  VoxelRange range_;
  VoxelIndex origin_;
  const MeshMapConfig& config_;
  const std::string& name_;
};

void require_legal(const MeshMapConfig& config, const std::string& name) {
  validate_voxel_size(config.voxel_size, "voxel_size");
  if (config.bounds) validate_box(*config.bounds, "bounds");
  for (const Point& place : config.inside)
    if (!place.allFinite())
      throw InputError("inside", "is no place for " + name, "give three finite numbers");
}

void require_within_reach(const Box& box, double voxel_size, const std::string& name) {
  const double farthest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  if (farthest < kMaxVoxelIndex * voxel_size) return;
  throw InputError(name, "has a vertex at " + number_text(farthest) + " m, beyond 1e9 voxels",
                   "check its units, or give a larger voxel_size");
}

/// The blocks of the outermost layers, all of which a flood from the sides looks at.
double blocks_at_sides(const VoxelRange& range) {
  const VoxelRange within = {range.min + VoxelIndex{kBlockSide, kBlockSide, kBlockSide},
                             range.max - VoxelIndex{kBlockSide, kBlockSide, kBlockSide}};
  return range.block_count() - (within.empty() ? 0.0 : within.block_count());
}

}  // namespace

Box box_around(const TriangleSoup& mesh, const std::string& name) {
  if (mesh.triangles.empty()) throw InputError(name, "has no triangles", "give one with a surface");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box = {Point::Constant(kInfinity), Point::Constant(-kInfinity)};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t v : mesh.triangles[i]) {
      if (v >= mesh.vertices.size())
        throw InputError(name,
                         "has a triangle, number " + std::to_string(i) + ", of vertex " +
                             std::to_string(v) + " of " + std::to_string(mesh.vertices.size()),
                         kRepair);
      const Point& p = mesh.vertices[v];
      if (!p.allFinite())
        throw InputError(name, "has a vertex, number " + std::to_string(v) + ", that is not finite",
                         kRepair);
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
  return box;
}

OccupancyMap map_from_mesh(const TriangleSoup& mesh, const MeshMapConfig& config,
                           const std::string& name, MeshMapReport* told) {
  require_legal(config, name);
  MeshMapReport report;
  report.box = box_around(mesh, name);
  const VoxelRange whole = voxels_overlapping(report.box, config.voxel_size);
  require_within_reach(report.box, config.voxel_size, name);
  const Box bounds = config.bounds.value_or(report.box);
  // The surface where it ends at the bounds is a wall too, if the bounds are the mesh's own.
  VoxelRange range = voxels_overlapping(bounds, config.voxel_size);
  if (!bounds.min.allFinite() || !bounds.max.allFinite()) range = intersection(range, whole);
  const VoxelRange free_range = intersection(voxels_inside(bounds, config.voxel_size), range);
  if (!config.bounds && (range.empty() || free_range.empty()))
    throw InputError(name, "has no room for a voxel: it is " + size_text(report.box) + " m",
                     "check its units, or give a smaller voxel_size");
  if (range.empty() || free_range.empty())
    throw InputError(name, "has no voxel wholly within the bounds",
                     "it spans " + place_text(report.box.min) + " to " +
                         place_text(report.box.max) +
                         "; give larger bounds, or a smaller voxel_size");
  if (config.inside.empty())
    require_memory_for_blocks(blocks_at_sides(range), kPipelineBytesPerVoxel, name);
  const VoxelRange kept = grown(range, 1 + config.margin);
  const VoxelIndex origin = kept.min;
  const auto in_kept = [&](const VoxelRange& r) {
    return VoxelRange{r.min - origin, r.max - origin};
  };
  std::vector<Point> vertices = mesh.vertices;
  for (Point& vertex : vertices) vertex /= config.voxel_size;
  const BlockMasks walls = touched_voxels(
      from_voxel(origin, std::move(vertices), mesh.triangles, mesh.off / config.voxel_size, name),
      kept.max - kept.min + VoxelIndex{1, 1, 1}, name);
  const SpaceFlood flood = FreeSpace(walls, in_kept(range), origin, config, name).find(report);
  const BlockMasks reached = flood.reached();

  OccupancyMap map;
  map.voxel_size = config.voxel_size;
  map.origin = origin;
  std::vector<BlockIndex> blocks = walls.blocks;
  blocks.insert(blocks.end(), reached.blocks.begin(), reached.blocks.end());
  map.layout = BlockLayout(std::move(blocks));
  require_memory_for_blocks(map.layout.block_count(), kPipelineBytesPerVoxel, name);
  map.state = VoxelField<VoxelState>(map.layout);
  write_states(reached, VoxelState::kFree, in_kept(free_range), map);
  write_states(walls, VoxelState::kOccupied, in_kept(kept), map);
  map = normalised(std::move(map));
  if (report.free == MeshMapReport::Free::kSeeded && flood.reaches_sides()) {
    std::vector<VoxelIndex> seeds;
    for (const Point& place : config.inside) seeds.push_back(voxel_at(place, config.voxel_size));
    report.leak = find_leak(map, seeds, free_range);
  }
  if (told != nullptr) *told = report;
  return map;
}

}  // namespace ridgeway
