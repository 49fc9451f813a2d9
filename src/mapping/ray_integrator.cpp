// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ray_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "common/number_text.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"

namespace ridgeway::detail {
namespace {

/// The points of one voxel as one.
struct Ray {
  Point end;               // their mean
  Eigen::Vector3d normal;  // of length one, or zero
  Eigen::Vector3d along;   // from the sensor, of length one
  double range = 0.0;
  double count = 0.0;
  bool is_beyond = false;  // the range that is taken
};

std::vector<Ray> bundle(const std::vector<SurfacePoint>& points, const Point& sensor,
                        double voxel_size) {
  struct Entry {
    VoxelIndex voxel;
    std::size_t point;
    bool is_beyond;
    bool operator<(const Entry& other) const {
      if (voxel != other.voxel) return voxel < other.voxel;
      return is_beyond != other.is_beyond ? other.is_beyond : point < other.point;
    }
    bool is_with(const Entry& other) const {
      return voxel == other.voxel && is_beyond == other.is_beyond;
    }
  };
  std::vector<Entry> entries;
  entries.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    entries.push_back({voxel_at(points[i].position, voxel_size), i, points[i].is_beyond});
  std::sort(entries.begin(), entries.end());
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < entries.size();) {
    Ray ray{Point::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    const Entry first = entries[i];
    ray.is_beyond = first.is_beyond;
    for (; i < entries.size() && entries[i].is_with(first); ++i) {
      ray.end += points[entries[i].point].position;
      ray.normal += points[entries[i].point].normal;
      ray.count += 1.0;
    }
    ray.end /= ray.count;
    ray.normal = ray.normal.norm() > 0.5 * ray.count ? Eigen::Vector3d(ray.normal.normalized())
                                                     : Eigen::Vector3d::Zero();
    ray.range = (ray.end - sensor).norm();
    if (!(ray.range > 0.0)) continue;
    ray.along = (ray.end - sensor) / ray.range;
    rays.push_back(ray);
  }
  return rays;
}

/// Calls body(cell) for the cells of a unit grid that a segment passes, in order (Amanatides and
/// Woo 1987).
template <typename Body>
void walk(const Point& from, const Point& to, const Body& body) {
  const Eigen::Vector3d along = to - from;
  VoxelIndex cell = voxel_at(from, 1.0);
  const VoxelIndex last = voxel_at(to, 1.0);
  std::array<int*, 3> at{&cell.x, &cell.y, &cell.z};
  std::array<int, 3> step{};
  std::array<double, 3> next{}, stride{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = along[static_cast<Eigen::Index>(axis)];
    const double start = from[static_cast<Eigen::Index>(axis)];
    step[axis] = a > 0.0 ? 1 : -1;
    stride[axis] = a != 0.0 ? 1.0 / std::abs(a) : std::numeric_limits<double>::infinity();
    const double left = a > 0.0 ? *at[axis] + 1.0 - start : start - *at[axis];
    next[axis] = a != 0.0 ? left * stride[axis] : std::numeric_limits<double>::infinity();
  }
  const int cells =
      std::abs(last.x - cell.x) + std::abs(last.y - cell.y) + std::abs(last.z - cell.z);
  for (int i = 0; i <= cells; ++i) {
    body(cell);
    const auto axis =
        static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
    if (next[axis] > 1.0) return;
    *at[axis] += step[axis];
    next[axis] += stride[axis];
  }
}

/// The stretch of a ray that is looked at, metres from the sensor.
std::pair<double, double> stretch_of(const Ray& ray, const FusionConfig& config) {
  return {config.carve ? 0.0 : std::max(0.0, ray.range - config.truncation),
          ray.is_beyond ? config.max_range : ray.range + config.depth_behind};
}

/// The rays that pass each block, in the order of the rays; blocks in the order they are met.
struct Passages {
  std::vector<BlockIndex> blocks;
  std::vector<std::vector<std::uint32_t>> rays;
};

/// Throws InputError unless the passages of all rays are few enough to be gathered.
void require_room_for_passages(const std::vector<Ray>& rays, const FusionConfig& config) {
  constexpr double kMostPassages = 1e8, kBytes = 48.0;  // of each, while they are gathered
  double passages = 0.0;
  for (const Ray& ray : rays) {
    const auto [near, far] = stretch_of(ray, config);
    passages += 1.0 + ray.along.lpNorm<1>() * (far - near) / (kBlockSide * config.voxel_size);
  }
  if (passages > kMostPassages)
    throw InputError("voxel_size " + number_text(config.voxel_size),
                     "is too small for rays that reach so far",
                     "use a larger voxel size or a smaller max_range");
  require_memory(kBytes * passages, "a scan's rays",
                 "use a larger voxel size or a smaller max_range");
}

Passages find_passages(const std::vector<Ray>& rays, const Point& sensor,
                       const FusionConfig& config, const TsdfBlocks& blocks) {
  constexpr std::size_t kChunk = 256;
  std::size_t next_check = 100000;  // blocks: a map that does not fit is refused early
  const double side = kBlockSide * config.voxel_size;
  std::vector<std::vector<std::pair<BlockIndex, std::uint32_t>>> parts((rays.size() + kChunk - 1) /
                                                                       kChunk);
  parallel_for_each_index(parts.size(), [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kChunk, rays.size());
    for (std::size_t i = part * kChunk; i < end; ++i) {
      const auto [near, far] = stretch_of(rays[i], config);
      walk((sensor + near * rays[i].along) / side, (sensor + far * rays[i].along) / side,
           [&](const VoxelIndex& cell) {
             if (const BlockIndex block{cell.x, cell.y, cell.z}; blocks.takes(block))
               parts[part].emplace_back(block, static_cast<std::uint32_t>(i));
           });
    }
  });
  Passages passages;
  std::unordered_map<BlockIndex, std::size_t, BlockHash> place;
  for (const auto& part : parts)
    for (const auto& [block, ray] : part) {
      const auto [found, is_new] = place.try_emplace(block, passages.blocks.size());
      if (is_new) {
        passages.blocks.push_back(block);
        passages.rays.emplace_back();
      }
      passages.rays[found->second].push_back(ray);
      if (passages.blocks.size() < next_check) continue;
      require_room(blocks, static_cast<double>(next_check));
      next_check *= 2;
    }
  return passages;
}

/// Where a ray enters and leaves a block, metres from the sensor, or a little farther: a ray in the
/// plane between two blocks may be found in either. No length if it misses it.
std::pair<double, double> clip(const Ray& ray, const Point& sensor, const BlockIndex& block,
                               double side, std::pair<double, double> stretch) {
  constexpr double kRounding = 1e-6;  // of a block
  const Point low = Point(block.x, block.y, block.z) * side;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = ray.along[axis];
    const double to_low = low[axis] - sensor[axis] - kRounding * side;
    const double to_high = to_low + (1.0 + 2.0 * kRounding) * side;
    if (a == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return {0.0, 0.0};
      continue;
    }
    stretch.first = std::max(stretch.first, std::min(to_low / a, to_high / a));
    stretch.second = std::min(stretch.second, std::max(to_low / a, to_high / a));
  }
  return stretch;
}

void update(const Ray& ray, const Point& sensor, const BlockIndex& index,
            const FusionConfig& config, TsdfBlock& block) {
  const double side = kBlockSide * config.voxel_size;
  const auto [near, far] = clip(ray, sensor, index, side, stretch_of(ray, config));
  if (near >= far) return;
  const double facing = -ray.normal.dot(ray.along);
  const double gain = ray.count * (facing > 0.0 ? std::max(facing, kLeastFacing) : kLeastFacing) /
                      (ray.range * ray.range);
  walk((sensor + near * ray.along) / config.voxel_size,
       (sensor + far * ray.along) / config.voxel_size, [&](const VoxelIndex& voxel) {
         if (block_of(voxel) != index) return;
         const Eigen::Vector3d to_end = ray.end - centre_of(voxel, config.voxel_size);
         double value = facing > 0.0 ? -ray.normal.dot(to_end) : ray.along.dot(to_end);
         // Seen at a slant, the plane of a surface runs on where the surface may have ended.
         const double beside = facing > 0.0 ? to_end.squaredNorm() - value * value : 0.0;
         if (beside > config.truncation * config.truncation) {
           if (value < 0.0) return;
           value = config.truncation;
         }
         if (value >= config.truncation && !config.carve) return;
         if (value <= 0.0 && ray.is_beyond) return;
         block.add(local_of(voxel), static_cast<float>(std::min(value, config.truncation)),
                   static_cast<float>(gain) * gain_of(static_cast<float>(value), config), config);
       });
}

/// Many rays of a scan pass a voxel, and are one look at it: what is forgotten counts looks.
void update_at_once(const std::vector<Ray>& rays, const std::vector<std::uint32_t>& passing,
                    const Point& sensor, const BlockIndex& index, const FusionConfig& config,
                    TsdfBlock& block) {
  FusionConfig of_scan = config;
  of_scan.forget_after = 0;
  TsdfBlock scan;
  for (const std::uint32_t ray : passing) update(rays[ray], sensor, index, of_scan, scan);
  for (int voxel = 0; voxel < kBlockVoxels; ++voxel)
    if (const auto v = static_cast<std::size_t>(voxel); scan.weight[v] > 0.0f)
      block.add(voxel, scan.distance[v], scan.weight[v], config);
}

}  // namespace

void integrate_rays(const std::vector<SurfacePoint>& points, const Point& sensor,
                    const FusionConfig& config, TsdfBlocks& blocks) {
  const std::vector<Ray> rays = bundle(points, sensor, config.voxel_size);
  require_room_for_passages(rays, config);
  const Passages passages = find_passages(rays, sensor, config, blocks);
  require_room(blocks, static_cast<double>(passages.blocks.size()));
  std::vector<TsdfBlock*> targets;
  targets.reserve(passages.blocks.size());
  for (const BlockIndex& index : passages.blocks) targets.push_back(&blocks.find_or_add(index));
  if (config.can_undo) blocks.keep_touched();
  parallel_for_each_index(passages.blocks.size(), [&](std::size_t i) {
    if (config.forget_after > 0)
      return update_at_once(rays, passages.rays[i], sensor, passages.blocks[i], config,
                            *targets[i]);
    for (const std::uint32_t ray : passages.rays[i])
      update(rays[ray], sensor, passages.blocks[i], config, *targets[i]);
  });
}

}  // namespace ridgeway::detail
