// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/distance_field.hpp"
#include "voxel/for_each_voxel.hpp"

namespace ridgeway {
namespace {

/// Truncated distance of a voxel; false where it was never seen.
bool value_at(const TsdfMap& tsdf, const VoxelIndex& voxel, double& value) {
  const VoxelId id = tsdf.layout.find(voxel);
  if (id == kNoVoxel || !(tsdf.weight[id] > 0.0f)) return false;
  value = static_cast<double>(tsdf.distance[id]);
  return true;
}

/// Change along an axis a voxel; 0 where no neighbour is known.
double slope_at(const TsdfMap& tsdf, const VoxelIndex& voxel, const VoxelIndex& step, double here) {
  double before = here, after = here;
  const int known = value_at(tsdf, voxel - step, before) + value_at(tsdf, voxel + step, after);
  return known == 0 ? 0.0 : (after - before) / known;
}

/// From a site's centre to the surface, metres: no longer than to the voxel's own neighbours.
Eigen::Vector3d offset_to_surface(const TsdfMap& tsdf, const VoxelIndex& site) {
  double value = 0.0;
  if (!value_at(tsdf, site, value)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d gradient = Eigen::Vector3d(slope_at(tsdf, site, {1, 0, 0}, value),
                                                   slope_at(tsdf, site, {0, 1, 0}, value),
                                                   slope_at(tsdf, site, {0, 0, 1}, value)) /
                                   tsdf.voxel_size;
  // A true distance has slope 1; much less and the point would be far off.
  constexpr double kLeastSlope = 0.25;
  if (gradient.norm() < kLeastSlope) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d offset = -value * gradient / gradient.squaredNorm();
  const double length = offset.norm();
  return length > tsdf.voxel_size ? Eigen::Vector3d(offset * (tsdf.voxel_size / length)) : offset;
}

class Refinement {
 public:
  Refinement(const EsdfMap& esdf, const TsdfMap& tsdf)
      : esdf_(esdf),
        tsdf_(tsdf),
        to_tsdf_(esdf.origin - tsdf.origin),
        to_surface_(esdf.layout, Eigen::Vector3f::Zero()) {}

  SubvoxelDistances run() {
    detail::for_each_voxel(esdf_.layout, [&](VoxelId id) {
      if (esdf_.obstacle.test(id))
        to_surface_[id] =
            offset_to_surface(tsdf_, esdf_.layout.index_of(id) + to_tsdf_).cast<float>();
    });
    SubvoxelDistances result{VoxelField<float>(esdf_.layout)};
    std::vector<double> change(esdf_.layout.block_count(), 0.0);  // the largest of each block
    detail::for_each_voxel(esdf_.layout, [&](VoxelId id) {
      const double distance = distance_of(id);
      result.distance[id] = static_cast<float>(distance);
      if (distance >= 0.0 && std::isfinite(distance))
        change[id / kBlockVoxels] =
            std::max(change[id / kBlockVoxels], std::abs(distance - esdf_.distance(id)));
    });
    for (const double c : change) result.error_bound = std::max(result.error_bound, c);
    return result;
  }

 private:
  double distance_of(VoxelId id) const {
    const VoxelIndex voxel = esdf_.layout.index_of(id);
    if (esdf_.obstacle.test(id)) {
      double value = 0.0;
      value_at(tsdf_, voxel + to_tsdf_, value);
      return std::min(value, 0.0);
    }
    double nearest = std::numeric_limits<double>::infinity();
    if (esdf_.squared[id] == kNoSite) return nearest;
    SiteOffset last{};
    for (int direction = 0; direction < 27; ++direction) {
      const VoxelId other = esdf_.layout.neighbour(id, direction);
      if (other == kNoVoxel || esdf_.squared[other] == kNoSite) continue;
      const VoxelIndex o = offset_of(direction);
      const SiteOffset s = esdf_.site[other];
      const SiteOffset from_here{static_cast<std::int16_t>(o.x + s.x),
                                 static_cast<std::int16_t>(o.y + s.y),
                                 static_cast<std::int16_t>(o.z + s.z)};
      if (from_here == last) continue;
      last = from_here;
      nearest = std::min(nearest, distance_to(voxel, from_here));
    }
    return nearest;
  }

  double distance_to(const VoxelIndex& voxel, const SiteOffset& o) const {
    const VoxelIndex site = voxel + VoxelIndex{o.x, o.y, o.z};
    const VoxelId id = esdf_.layout.find(site);
    Eigen::Vector3d way = Eigen::Vector3d(o.x, o.y, o.z) * esdf_.voxel_size;
    if (id != kNoVoxel) way += to_surface_[id].cast<double>();
    return way.norm();
  }

  const EsdfMap& esdf_;
  const TsdfMap& tsdf_;
  const VoxelIndex to_tsdf_;                // from the ESDF's voxels to the others
  VoxelField<Eigen::Vector3f> to_surface_;  // of obstacle voxels
};

}  // namespace

SubvoxelDistances subvoxel_distances(const EsdfMap& esdf, const TsdfMap& tsdf) {
  if (esdf.voxel_size != tsdf.voxel_size)
    throw InputError("voxel_size",
                     "is " + number_text(tsdf.voxel_size) + " where the ESDF's is " +
                         number_text(esdf.voxel_size),
                     "give the truncated distances that the ESDF's map was made of");
  return Refinement(esdf, tsdf).run();
}

}  // namespace ridgeway
