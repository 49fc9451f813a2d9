// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "ridgeway/common/error.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"

namespace ridgeway {
namespace {

/// A coordinate in voxels, moved onto the lattice plane it is meant to lie on.
double lattice_coordinate(double metres, double voxel_size) {
  const double voxels = metres / voxel_size;
  const double nearest = std::round(voxels);
  constexpr double kSlack = 1e-6;  // rounding of 1e9 voxels is less
  return std::abs(voxels - nearest) <= kSlack ? nearest : voxels;
}

int clamped_index(double voxels) {
  return static_cast<int>(std::clamp(voxels, -static_cast<double>(kMaxVoxelIndex),
                                     static_cast<double>(kMaxVoxelIndex)));
}

}  // namespace

double VoxelRange::block_count() const {
  if (empty()) return 0.0;
  const BlockIndex first = block_of(min), last = block_of(max);
  return (static_cast<double>(last.x) - first.x + 1) * (static_cast<double>(last.y) - first.y + 1) *
         (static_cast<double>(last.z) - first.z + 1);
}

VoxelRange intersection(const VoxelRange& a, const VoxelRange& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
}

VoxelRange grown(const VoxelRange& range, std::int64_t voxels) {
  if (range.empty()) return range;
  const auto moved = [](int index, std::int64_t by) {
    return static_cast<int>(std::clamp<std::int64_t>(index + by, -kMaxVoxelIndex, kMaxVoxelIndex));
  };
  return {{moved(range.min.x, -voxels), moved(range.min.y, -voxels), moved(range.min.z, -voxels)},
          {moved(range.max.x, voxels), moved(range.max.y, voxels), moved(range.max.z, voxels)}};
}

VoxelRange moved(const VoxelRange& range, const VoxelIndex& voxels) {
  const std::int64_t end = std::int64_t{2} * kMaxVoxelIndex;
  const auto add = [end](int a, int b) {
    return static_cast<int>(std::clamp(std::int64_t{a} + b, -end, end));
  };
  return {{add(range.min.x, voxels.x), add(range.min.y, voxels.y), add(range.min.z, voxels.z)},
          {add(range.max.x, voxels.x), add(range.max.y, voxels.y), add(range.max.z, voxels.z)}};
}

void require_within_reach(const VoxelRange& range, const std::string& name) {
  if (range.empty() || intersection(range, kAllVoxels) == range) return;
  throw InputError(name, "has a voxel farther than 1e9 voxels from the origin of its coordinates",
                   "check the units of its transform, or use a larger voxel size");
}

void validate_box(const Box& box, const std::string& name) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min[axis] <= box.max[axis]) continue;  // false where either is not a number
    std::ostringstream what;
    what << std::setprecision(12) << "along "
         << "xyz"[axis] << " runs from " << box.min[axis] << " to " << box.max[axis];
    throw InputError(name, what.str(), "give numbers with min <= max");
  }
}

VoxelRange voxels_inside(const Box& box, double voxel_size) {
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = clamped_index(std::ceil(lattice_coordinate(box.min[axis], voxel_size)));
    last[axis] = clamped_index(std::floor(lattice_coordinate(box.max[axis], voxel_size)) - 1);
  }
  return {{first[0], first[1], first[2]}, {last[0], last[1], last[2]}};
}

VoxelRange voxels_overlapping(const Box& box, double voxel_size) {
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = clamped_index(std::floor(lattice_coordinate(box.min[axis], voxel_size)));
    last[axis] = clamped_index(std::ceil(lattice_coordinate(box.max[axis], voxel_size)) - 1);
    last[axis] = std::max(first[axis], last[axis]);
  }
  return {{first[0], first[1], first[2]}, {last[0], last[1], last[2]}};
}

}  // namespace ridgeway
