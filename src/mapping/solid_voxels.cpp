// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "solid_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "memory_limit.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "sensing/box_between_planes.hpp"
#include "touched_voxels.hpp"

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
  template <typename Solids>
  bool touches_any(const Solids& solids) const {
    return std::any_of(solids.begin(), solids.end(),
                       [&](const auto& solid) { return touches(solid); });
  }
  /// All but the meshes.
  bool touches_solids(const World& world) const {
    return touches_any(world.planes) || touches_any(world.boxes) || touches_any(world.spheres) ||
           touches_any(world.cylinders);
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

/// The triangles of a mesh in voxels from the map's origin.
VoxelTriangles in_voxels(const PlacedMesh& placed, const OccupancyMap& map,
                         const std::string& name) {
  const TriangleTree& tree = placed.mesh->tree();
  std::vector<Point> vertices;
  vertices.reserve(tree.vertices().size());
  for (const Point& vertex : tree.vertices())
    vertices.emplace_back(placed.T_world_mesh * (placed.scale * vertex) / map.voxel_size);
  return from_voxel(map.origin, std::move(vertices),
                    {tree.triangles().begin(), tree.triangles().end()}, 0.0, name);
}

/// Which voxels of a block lie within a closed mesh, of those that its surface does not touch.
/// Neighbours of them are on the same side, so one is asked for each run of them.
VoxelMask::Block inside_of(const PlacedMesh& placed, const OccupancyMap& map, std::uint32_t slot,
                           const VoxelMask::Block& surface) {
  const Eigen::Isometry3d T_mesh_world = placed.T_world_mesh.inverse();
  const auto is_inside = [&](VoxelId id) {
    const Point centre = to_world(map, centre_of(map.layout.index_of(id), map.voxel_size));
    return placed.mesh->encloses(T_mesh_world * centre / placed.scale);
  };
  const VoxelId first = slot * kBlockVoxels;
  VoxelMask::Block inside{};
  if (std::all_of(surface.begin(), surface.end(), [](std::uint64_t z) { return z == 0; })) {
    if (is_inside(first)) inside.fill(~std::uint64_t{0});
    return inside;
  }
  bool is_known = false, last = false;
  for (VoxelId local = 0; local < kBlockVoxels; ++local) {
    const std::uint64_t bit = std::uint64_t{1} << (local & 63);
    const bool is_surface = (surface[local >> 6] & bit) != 0;
    is_known &= !is_surface && local % kBlockSide != 0;
    if (is_surface) continue;
    if (!is_known) last = is_inside(first + local);
    is_known = true;
    if (last) inside[local >> 6] |= bit;
  }
  return inside;
}

/// Adds the voxels that a mesh touches or encloses. The map's voxels begin at its origin.
void add_mesh(const PlacedMesh& placed, const OccupancyMap& map, const VoxelIndex& size,
              const std::string& name, VoxelMask& solid) {
  const BlockMasks touched = touched_voxels(in_voxels(placed, map, name), size, name);
  VoxelMask surface(map.layout);
  for (std::size_t i = 0; i < touched.blocks.size(); ++i)
    surface.block(map.layout.find_block(touched.blocks[i])) = touched.voxels[i];
  parallel_for_each_index(map.layout.block_count(), [&](std::size_t i) {
    const auto slot = static_cast<std::uint32_t>(i);
    const VoxelMask::Block& own = surface.block(slot);
    const VoxelMask::Block inside =
        placed.mesh->is_closed() ? inside_of(placed, map, slot, own) : VoxelMask::Block{};
    for (std::size_t z = 0; z < kBlockSide; ++z) solid.block(slot)[z] |= own[z] | inside[z];
  });
}

}  // namespace

std::optional<Box> extent_of(const World& world) {
  const auto [floor, ceiling] = detail::box_between(world.planes);
  Box open = {floor, ceiling};
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
  VoxelMask meshes(map.layout);
  for (const PlacedMesh& placed : world.meshes)
    add_mesh(placed, map, range.max - range.min + VoxelIndex{1, 1, 1}, name, meshes);
  parallel_for_each_index(map.layout.block_count(), [&](std::size_t slot) {
    const auto first = static_cast<VoxelId>(slot * kBlockVoxels);
    // Where nothing touches the block as a whole, nothing touches its voxels.
    const VoxelIndex corner = map.origin + map.layout.index_of(first);
    const double side = kBlockSide * voxel_size;
    const Point middle =
        Point(corner.x, corner.y, corner.z) * voxel_size + Vector::Constant(0.5 * side);
    const bool is_empty = !Cube(middle, side).touches_solids(world);
    for (VoxelId id = first; id < first + kBlockVoxels; ++id) {
      const VoxelIndex voxel = map.origin + map.layout.index_of(id);
      if (!range.contains(voxel)) continue;
      const bool is_solid =
          meshes.test(id) ||
          (!is_empty && Cube(centre_of(voxel, voxel_size), voxel_size).touches_solids(world));
      map.state[id] = is_solid ? VoxelState::kOccupied : VoxelState::kFree;
    }
  });
  return map;
}

}  // namespace ridgeway
