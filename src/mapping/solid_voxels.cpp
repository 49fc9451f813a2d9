// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "solid_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "memory_limit.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

using Vector = Eigen::Vector3d;

/// A closed cube, grown by a little more than rounding.
class Cube {
 public:
  Cube(const Point& centre, double side) : centre_(centre), half_(0.5 * side * (1.0 + 1e-9)) {}

  bool touches(const SolidPlane& plane) const {
    return plane.normal.dot(centre_) - half_ * plane.normal.cwiseAbs().sum() <= plane.offset;
  }
  bool touches(const SolidBox& box) const { return away(box.centre, 0.5 * box.size).isZero(0.0); }
  bool touches(const SolidSphere& sphere) const {
    return away(sphere.centre, Vector::Zero()).norm() <= sphere.radius;
  }
  bool touches(const SolidCylinder& cylinder) const {
    const Vector gap = away(cylinder.centre, {0.0, 0.0, 0.5 * cylinder.height});
    return gap.z() == 0.0 && gap.head<2>().norm() <= cylinder.radius;
  }
  bool touches(const PlacedMesh& placed) const {
    const Point p = placed.T_world_mesh.inverse() * centre_ / placed.scale;
    return placed.mesh->distance(p).distance * placed.scale <= std::sqrt(3.0) * half_;
  }

  template <typename Solids>
  bool touches_any(const Solids& solids) const {
    return std::any_of(solids.begin(), solids.end(),
                       [&](const auto& solid) { return touches(solid); });
  }
  bool touches(const World& world) const {
    return touches_any(world.planes) || touches_any(world.boxes) || touches_any(world.spheres) ||
           touches_any(world.cylinders) || touches_any(world.meshes);
  }

 private:
  /// Along each axis, how far the cube is from a box.
  Vector away(const Point& centre, const Vector& half_size) const {
    const Vector gap = (centre_ - centre).cwiseAbs() - half_size;
    return (gap.array() - half_).max(0.0);
  }

  Point centre_;
  double half_;
};

void include(const Point& low, const Point& high, Box& box) {
  box.min = box.min.cwiseMin(low);
  box.max = box.max.cwiseMax(high);
}

Box box_of_solids(const World& world) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box = {Point::Constant(kInfinity), Point::Constant(-kInfinity)};
  const auto add = [&](const Point& centre, const Vector& half) {
    include(centre - half, centre + half, box);
  };
  for (const SolidBox& b : world.boxes) add(b.centre, 0.5 * b.size);
  for (const SolidSphere& s : world.spheres) add(s.centre, Vector::Constant(s.radius));
  for (const SolidCylinder& c : world.cylinders)
    add(c.centre, {c.radius, c.radius, 0.5 * c.height});
  for (const PlacedMesh& m : world.meshes) {
    const Eigen::AlignedBox3d moved =
        Eigen::AlignedBox3d(m.scale * m.mesh->low(), m.scale * m.mesh->high())
            .transformed(m.T_world_mesh);
    include(moved.min(), moved.max(), box);
  }
  return box;
}

}  // namespace

std::optional<Box> extent_of(const World& world) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box open = {Point::Constant(-kInfinity), Point::Constant(kInfinity)};
  for (const SolidPlane& plane : world.planes)
    for (int axis = 0; axis < 3; ++axis) {
      if (plane.normal[axis] == 1.0) open.min[axis] = std::max(open.min[axis], plane.offset);
      if (plane.normal[axis] == -1.0) open.max[axis] = std::min(open.max[axis], -plane.offset);
    }
  const Box solids = box_of_solids(world);
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(open.min[axis])) open.min[axis] = solids.min[axis];
    if (!std::isfinite(open.max[axis])) open.max[axis] = solids.max[axis];
  }
  const bool is_box =
      open.min.allFinite() && open.max.allFinite() && (open.min.array() <= open.max.array()).all();
  return is_box ? std::optional(open) : std::nullopt;
}

OccupancyMap touched_by(const World& world, double voxel_size, const Box& bounds,
                        const std::string& name) {
  validate_voxel_size(voxel_size, "voxel_size");
  validate_world(world);
  const VoxelRange range = grown(voxels_overlapping(bounds, voxel_size), 1);
  require_memory_for_blocks(range.block_count(), kPipelineBytesPerVoxel, name);
  require_within_reach(range, "bounds");
  OccupancyMap map;
  map.voxel_size = voxel_size;
  map.origin = range.min;
  std::vector<BlockIndex> blocks;
  const BlockIndex last = block_of(range.max - range.min);
  for (int z = 0; z <= last.z; ++z)
    for (int y = 0; y <= last.y; ++y)
      for (int x = 0; x <= last.x; ++x) blocks.push_back({x, y, z});
  map.layout = BlockLayout(std::move(blocks));
  map.state = VoxelField<VoxelState>(map.layout);
  parallel_for_each_index(map.layout.block_count(), [&](std::size_t slot) {
    const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
    // Where nothing touches the block as a whole, nothing touches its voxels.
    const VoxelIndex corner = map.origin + map.layout.index_of(first);
    const double side = kBlockSide * voxel_size;
    const Point middle =
        Point(corner.x, corner.y, corner.z) * voxel_size + Vector::Constant(0.5 * side);
    const bool is_empty = !Cube(middle, side).touches(world);
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
      const VoxelIndex voxel = map.origin + map.layout.index_of(id);
      if (!range.contains(voxel)) continue;
      const bool is_free =
          is_empty || !Cube(centre_of(voxel, voxel_size), voxel_size).touches(world);
      map.state[id] = is_free ? VoxelState::kFree : VoxelState::kOccupied;
    }
  });
  return map;
}

}  // namespace ridgeway
