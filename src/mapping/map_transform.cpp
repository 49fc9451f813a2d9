// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "memory_limit.hpp"
#include "planar.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"

namespace ridgeway {
namespace {

/// Do two cubes of fixed sizes and orientations share volume, depending on their centres? By
/// separating axes. In units of the source voxel, along its axes.
class CubeOverlap {
 public:
  /// `turn`: rotation from target to source axes; `side`: of the target cube.
  CubeOverlap(const Eigen::Matrix3d& turn, double side) {
    const auto add = [&](const Eigen::Vector3d& axis) {
      const double length = axis.norm();
      if (length < 1e-6) return;  // parallel edges: their cross product separates nothing new
      const Eigen::Vector3d a = axis / length;
      const double reach = 0.5 * a.lpNorm<1>() + 0.5 * side * (turn.transpose() * a).lpNorm<1>();
      axes_.push_back({a, reach * (1.0 - 1e-9)});
    };
    for (int i = 0; i < 3; ++i) {
      add(Eigen::Vector3d::Unit(i));
      add(turn.col(i));
      for (int j = 0; j < 3; ++j) add(Eigen::Vector3d::Unit(i).cross(turn.col(j)));
    }
  }

  bool operator()(const Eigen::Vector3d& between_centres) const {
    return std::all_of(axes_.begin(), axes_.end(), [&](const Axis& axis) {
      return std::abs(axis.direction.dot(between_centres)) < axis.reach;
    });
  }

 private:
  struct Axis {
    Eigen::Vector3d direction;
    double reach;
  };
  std::vector<Axis> axes_;
};

/// Reads voxels near each other without a look-up each.
class CachedReader {
 public:
  explicit CachedReader(const OccupancyMap& map) : map_(map) {}

  VoxelState operator()(const VoxelIndex& voxel) {
    if (const BlockIndex block = block_of(voxel); !valid_ || block != block_) {
      const std::uint32_t slot = map_.layout.find_block(block);
      states_ = slot == BlockLayout::kNoBlock ? nullptr : map_.state.block(slot);
      block_ = block;
      valid_ = true;
    }
    return states_ == nullptr ? VoxelState::kUnknown : states_[local_of(voxel)];
  }

 private:
  const OccupancyMap& map_;
  BlockIndex block_;
  const VoxelState* states_ = nullptr;
  bool valid_ = false;
};

/// Blocks of the target that the moved blocks of the source may touch; `motion` between their own
/// frames.
std::vector<BlockIndex> touched_blocks(const OccupancyMap& map, const Eigen::Isometry3d& motion,
                                       double voxel_size) {
  const double side = kBlockSide * map.voxel_size, target_side = kBlockSide * voxel_size;
  const Eigen::Vector3d half =
      0.5 * side * motion.linear().cwiseAbs() * Eigen::Vector3d::Ones() / target_side;
  std::vector<BlockIndex> blocks;
  for (const BlockIndex& b : map.layout.blocks()) {
    const Point centre = motion * (Point(b.x + 0.5, b.y + 0.5, b.z + 0.5) * side) / target_side;
    const Eigen::Vector3i low = (centre - half).array().floor().cast<int>();
    const Eigen::Vector3i high = (centre + half).array().floor().cast<int>();
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x) blocks.push_back({x, y, z});
  }
  return blocks;
}

/// What the cube around a point (in source voxels) meets.
VoxelState state_around(const Point& centre, const Eigen::Vector3d& half,
                        const CubeOverlap& overlaps, CachedReader& read) {
  const Eigen::Vector3i low = (centre - half).array().floor().cast<int>();
  const Eigen::Vector3i high = (centre + half).array().ceil().cast<int>() - 1;
  std::array<bool, 3> near{};
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x)
        near[static_cast<std::size_t>(read({x, y, z}))] = true;
  if (near[0] + near[1] + near[2] == 1) {
    return near[0] ? VoxelState::kUnknown : near[1] ? VoxelState::kFree : VoxelState::kOccupied;
  }
  bool meets_unknown = false, meets_free = false;
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const VoxelState state = read({x, y, z});
        bool& met = state == VoxelState::kUnknown ? meets_unknown : meets_free;
        if (state != VoxelState::kOccupied && met) continue;
        if (!overlaps(Point(x + 0.5, y + 0.5, z + 0.5) - centre)) continue;
        if (state == VoxelState::kOccupied) return state;
        met = true;
      }
  return meets_free && !meets_unknown ? VoxelState::kFree : VoxelState::kUnknown;
}

}  // namespace

VoxelRange LatticeTransform::operator()(const VoxelRange& source) const {
  const std::array<int, 3> low = {source.min.x, source.min.y, source.min.z};
  const std::array<int, 3> high = {source.max.x, source.max.y, source.max.z};
  std::array<int, 3> first, last;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto s = static_cast<std::size_t>(source_axis[a]);
    first[a] = flipped[a] ? -1 - high[s] : low[s];
    last[a] = flipped[a] ? -1 - low[s] : high[s];
  }
  return moved({{first[0], first[1], first[2]}, {last[0], last[1], last[2]}},
               {shift[0], shift[1], shift[2]});
}

void validate_transform(const Eigen::Isometry3d& transform) {
  const Eigen::Matrix3d turn = transform.linear();
  const bool finite = transform.matrix().allFinite();
  if (finite &&
      (turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-6 &&
      turn.determinant() > 0.0)
    return;
  throw InputError("transform", finite ? "is not a rotation and a translation" : "is not finite",
                   "give an orthonormal right-handed rotation and a translation in metres");
}

std::optional<LatticeTransform> find_lattice_transform(const Eigen::Isometry3d& T_target_source,
                                                       double voxel_size) {
  constexpr double slack = 1e-6;
  constexpr double straight = 1e-9;  // of an axis off its row: below a voxel over any map's reach
  LatticeTransform result;
  for (int a = 0; a < 3; ++a) {
    int axis = 0;
    const double entry = T_target_source.linear().row(a).cwiseAbs().maxCoeff(&axis);
    const double moved = T_target_source.translation()[a] / voxel_size;
    const double off_axis = T_target_source.linear().row(a).cwiseAbs().sum() - entry;
    if (std::abs(entry - 1.0) > slack || off_axis > straight ||
        std::abs(moved - std::round(moved)) > slack || std::abs(moved) > kMaxVoxelIndex)
      return std::nullopt;
    const auto place = static_cast<std::size_t>(a);
    result.source_axis[place] = axis;
    result.flipped[place] = T_target_source.linear()(a, axis) < 0.0;
    result.shift[place] = static_cast<int>(std::round(moved));
  }
  return result;
}

OccupancyMap transform_map(const OccupancyMap& map, const Eigen::Isometry3d& T_target_source,
                           double voxel_size) {
  validate_transform(T_target_source);
  validate_voxel_size(voxel_size, "voxel_size");
  detail::require_three_dimensions(map);
  const double ratio = voxel_size / map.voxel_size;
  if (ratio < 1.0 - 1e-6) {
    std::ostringstream what;
    what << voxel_size << " m is finer than the map's own " << map.voxel_size << " m";
    throw InputError("voxel_size", what.str(), "leave it out, or give a larger one");
  }
  if (T_target_source.translation().cwiseAbs().maxCoeff() / voxel_size > kMaxVoxelIndex)
    throw InputError("transform", "moves the map by more than 1e9 voxels", "check its units");

  // Much coarser voxels would each read very many: turn at about the map's own size first.
  if (const double parts = std::floor(ratio + 1e-6); parts > 1.0)
    return resample(transform_map(map, T_target_source, voxel_size / parts), voxel_size);

  const Point zero = T_target_source * to_world(map, Point::Zero());
  OccupancyMap result;
  result.voxel_size = voxel_size;
  result.origin = voxel_at(zero, voxel_size);
  Eigen::Isometry3d T_result_map = T_target_source;  // between their own frames
  T_result_map.translation() = moved(zero, VoxelIndex{} - result.origin, voxel_size);
  result.layout = BlockLayout(touched_blocks(map, T_result_map, voxel_size));
  require_memory_for_blocks(result.layout.block_count(), kMapBytesPerVoxel, "map");
  result.state = VoxelField<VoxelState>(result.layout);

  const Eigen::Isometry3d T_map_result = T_result_map.inverse();
  const CubeOverlap overlaps(T_map_result.linear(), ratio);
  const Eigen::Vector3d half =
      0.5 * ratio * T_map_result.linear().cwiseAbs() * Eigen::Vector3d::Ones();
  parallel_for_each_index(result.layout.block_count(), [&](std::size_t i) {
    const auto slot = static_cast<std::uint32_t>(i);
    CachedReader read(map);
    for (int local = 0; local < kBlockVoxels; ++local) {
      const VoxelIndex v = voxel_of(result.layout.block(slot), local);
      const Point centre = T_map_result * centre_of(v, voxel_size) / map.voxel_size;
      result.state.block(slot)[local] = state_around(centre, half, overlaps, read);
    }
  });
  return normalised(std::move(result));
}

}  // namespace ridgeway
