// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/formats/point_cloud.hpp"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "common/number_text.hpp"
#include "load_steps.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

std::string describe(const Point& p) {
  std::ostringstream text;
  text << std::setprecision(12) << p.x() << ',' << p.y() << ',' << p.z();
  return text.str();
}

VoxelRange checked_range(const Box& bounds, double voxel_size) {
  validate_box(bounds, "bounds");
  const double reach = kMaxVoxelIndex * voxel_size;
  if (!(bounds.min.cwiseAbs().maxCoeff() < reach && bounds.max.cwiseAbs().maxCoeff() < reach)) {
    throw InputError("bounds", "reach farther than 1e9 voxels from the origin",
                     "give finite bounds around the space that is known");
  }
  const VoxelRange range = voxels_inside(bounds, voxel_size);
  if (range.empty()) {
    throw InputError("bounds", "hold no whole voxel of " + number_text(voxel_size) + " m",
                     "give larger bounds or a smaller voxel_size");
  }
  return range;
}

/// Finds the voxels of points. A transform by whole voxels moves the voxels, not the points: that
/// leaves them where they are in their voxels, however far it goes.
class CloudVoxels {
 public:
  CloudVoxels(const Eigen::Isometry3d& T_map_cloud, double voxel_size) : voxel_size_(voxel_size) {
    const auto motion = find_lattice_transform(T_map_cloud, voxel_size);
    if (motion && motion->source_axis == LatticeTransform{}.source_axis &&
        motion->flipped == LatticeTransform{}.flipped)
      shift_ = {motion->shift[0], motion->shift[1], motion->shift[2]};
  }

  VoxelIndex find(const Point& point_cloud, const Point& point_map) const {
    return shift_ ? voxel_at(point_cloud, voxel_size_) + *shift_ : voxel_at(point_map, voxel_size_);
  }

 private:
  double voxel_size_;
  std::optional<VoxelIndex> shift_;
};

}  // namespace

std::string describe(const Box& box) { return describe(box.min) + " to " + describe(box.max); }

void require_no_faces(const PointCloud& cloud, const std::string& name) {
  if (cloud.faces == 0) return;
  throw InputError(name,
                   "is a mesh of " + std::to_string(cloud.faces) +
                       " faces; a map of its vertices alone would be open between them",
                   "write the points of the scan without faces; the mesh itself is mapped by "
                   "`ridgeway build`");
}

Box extent(const PointCloud& cloud, const Eigen::Isometry3d& T_map_cloud) {
  if (cloud.points.empty()) return {};
  Eigen::AlignedBox3d box;
  for (const Point& point : cloud.points) box.extend(T_map_cloud * point);
  return {box.min(), box.max()};
}

namespace {

bool is_beside(const Box& box, const Point& point) {
  constexpr double kRounding = 1e-9;
  const Point slack = kRounding * (box.max - box.min);
  return ((point - box.min + slack).array() < 0.0).any() ||
         ((box.max - point + slack).array() < 0.0).any();
}

/// Obstacles that are left out would be free space, so nobody may overlook that.
void tell_of_points_left_out(const PointCloud& cloud, std::size_t outside, const Box& span,
                             LoadNotes* notes) {
  const std::size_t count = cloud.points.size();
  if (cloud.skipped > 0)
    tell(notes, std::to_string(cloud.skipped) + " of " + std::to_string(cloud.skipped + count) +
                    " points were skipped: a coordinate is not finite");
  if (outside == 0) return;
  const bool are_most = 2 * outside > count;
  tell(notes, std::to_string(outside) + " of " + std::to_string(count) +
                  " points lie outside of the bounds and are left out" +
                  (are_most ? "; all points span " + describe(span) +
                                  ": are the bounds in metres, and the points too?"
                            : ""));
}

}  // namespace

OccupancyMap map_from_points(const PointCloud& cloud, const CloudMapConfig& config,
                             const std::string& name, LoadNotes* notes) {
  validate_voxel_size(config.voxel_size, "voxel_size");
  validate_transform(config.T_map_cloud);
  if (config.margin < 0)
    throw InputError("margin", "is " + std::to_string(config.margin), "give voxels, 0 or more");
  const VoxelRange known = checked_range(config.bounds, config.voxel_size);
  // With voxels that stick out of the bounds, or touch them: points on them are obstacles, too.
  OccupancyBuilder builder(config.voxel_size,
                           {.clip = grown(known, std::max(config.margin, 1)), .name = name});
  builder.fill(known, VoxelState::kFree);
  const double reach = kMaxVoxelIndex * config.voxel_size;
  const CloudVoxels voxels(config.T_map_cloud, config.voxel_size);
  const VoxelIndex lowest = voxels_overlapping(config.bounds, config.voxel_size).min;
  std::size_t inside = 0, outside = 0;
  for (const Point& point_cloud : cloud.points) {
    const Point point = config.T_map_cloud * point_cloud;
    if (!(point.cwiseAbs().maxCoeff() < reach && point_cloud.cwiseAbs().maxCoeff() < reach)) {
      throw InputError(name, "has a point at " + describe(point) + ", beyond 1e9 voxels",
                       "check the units of the cloud and voxel_size");
    }
    const bool is_outside = is_beside(config.bounds, point);
    (is_outside ? outside : inside) += 1;
    if (is_outside && config.margin == 0) continue;
    VoxelIndex voxel = voxels.find(point_cloud, point);
    // Where bounds lie between two voxels, rounding finds what lies on them in either.
    if (!is_outside)
      voxel = {std::max(voxel.x, lowest.x), std::max(voxel.y, lowest.y),
               std::max(voxel.z, lowest.z)};
    builder.set(voxel, VoxelState::kOccupied);
  }
  if (cloud.points.empty())
    throw InputError(name, "has no points", "record or write the cloud again");
  if (inside == 0) {
    throw InputError(name, "has no point within the bounds " + describe(config.bounds),
                     "its points span " + describe(extent(cloud, config.T_map_cloud)));
  }
  tell_of_points_left_out(cloud, outside, extent(cloud, config.T_map_cloud), notes);
  return std::move(builder).finish();
}

}  // namespace ridgeway
