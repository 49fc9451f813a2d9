// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/mapping/tsdf_fusion.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "common/require.hpp"
#include "depth_ranges.hpp"
#include "depth_surfaces.hpp"
#include "projective_integrator.hpp"
#include "ray_integrator.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/mapping/occupancy_map.hpp"
#include "state_changes.hpp"
#include "thin_surfaces.hpp"
#include "tsdf_blocks.hpp"

namespace ridgeway {
namespace {

using detail::require;

constexpr double kDefaultTruncation = 4.0, kDefaultDepth = 2.0;  // voxels
constexpr double kMostVoxels = 1e8;                              // along a ray
constexpr double kFarthestVoxel = 0.5 * kMaxVoxelIndex;  // so that all a ray reaches has an index

void require_fits(const DepthImage& image, const PinholeCamera& camera) {
  camera.validate();
  const auto pixels =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  if (image.width == camera.width && image.height == camera.height && image.depth.size() != pixels)
    throw InputError(
        "depth image",
        "has " + std::to_string(image.depth.size()) + " depths, not " + std::to_string(pixels),
        "give width times height of them, row by row");
  if (image.width != camera.width || image.height != camera.height)
    throw InputError("depth image",
                     "is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " where the camera is " + std::to_string(camera.width) + " x " +
                         std::to_string(camera.height),
                     "give the intrinsics of this size");
}

/// Of surfaces, and of what lies beyond the range.
std::vector<detail::SurfacePoint> points_of(const detail::DepthSurfaces& surfaces,
                                            const DepthImage& beyond, const PinholeCamera& camera,
                                            const Eigen::Isometry3d& T_map_camera) {
  const DepthImage& image = surfaces.image();
  std::vector<detail::SurfacePoint> points;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const auto depth = static_cast<double>(image.at(u, v));
      if (depth > 0.0)
        points.push_back(
            {T_map_camera * Point(depth * camera.ray(u, v)),
             T_map_camera.linear() * surfaces.normal(surfaces.tile_at(u, v)).cast<double>()});
      if (const auto far = static_cast<double>(beyond.at(u, v)); far > 0.0)
        points.push_back(
            {T_map_camera * Point(far * camera.ray(u, v)), Eigen::Vector3d::Zero(), true});
    }
  return points;
}

/// Where the robot has been is free, where nothing was measured: obstacles near its way stay. All
/// is in the map's own frame.
void clear_sphere(const Point& centre, double radius, TsdfMap& map) {
  detail::for_each_in_sphere(centre, radius, map.voxel_size, [&](const VoxelIndex& v) {
    const VoxelId id = map.layout.find(v);
    if (id == kNoVoxel || map.weight[id] > 0.0f) return;
    map.distance[id] = static_cast<float>(map.truncation);
    map.weight[id] = 1.0f;
  });
}

}  // namespace

void FusionConfig::validate() const {
  if (integrator != Integrator::kProjective && integrator != Integrator::kRayCasting)
    throw InputError("integrator", "is no enumerator of Integrator",
                     "give kProjective or kRayCasting");
  validate_voxel_size(voxel_size, "voxel_size");
  require(min_range >= 0.0 && std::isfinite(min_range), "min_range", min_range,
          "give metres, 0 or more");
  require(max_range > min_range && std::isfinite(max_range), "max_range", max_range,
          "give metres, above min_range");
  require(voxel_size <= max_range, "voxel_size", voxel_size, "give max_range or less");
  require(max_range <= kMostVoxels * voxel_size, "max_range", max_range,
          "give 1e8 voxels or less, or a larger voxel_size");
  require(truncation == 0.0 || (truncation >= voxel_size && truncation <= max_range), "truncation",
          truncation, "give a voxel's length or more, to max_range, or 0 for four voxels");
  require(depth_behind == 0.0 || (depth_behind >= voxel_size && depth_behind <= max_range),
          "depth_behind", depth_behind,
          "give a voxel's length or more, to max_range, or 0 for two voxels");
  require(static_cast<float>(max_weight) > 0.0f, "max_weight", max_weight,
          "give a number above 0, 1e-37 or more");
  require(forget_after >= 0 && forget_after <= 255, "forget_after", forget_after,
          "give 1 to 255 measurements, or 0 for never");
  if (origin) require_within_reach({*origin, *origin}, "origin");
  require(clear_radius >= 0.0 && clear_radius <= max_range, "clear_radius", clear_radius,
          "give metres, 0 for none");
}

/// Blocks and places are in the map's own frame.
struct TsdfFusion::State {
  FusionConfig config;
  std::optional<VoxelIndex> origin;  // the voxel that held the sensor at first
  detail::TsdfBlocks blocks;
  std::vector<Point> places;  // of the sensor
  detail::AcceptedStates accepted;
  std::vector<Point> places_before;  // of the last take_over
  bool is_undoable = false, took_over = false;
  std::unordered_set<BlockIndex, BlockHash> only;  // where it is a part of another fusion

  /// A pose is recorded only once its measurements are in: what throws on the way leaves no trace
  /// of it, nor of the origin that the first pose gives. `measure` adds the measurements from a
  /// pose in the map's own frame.
  template <typename Measure>
  void visit(const Eigen::Isometry3d& T_world_sensor, const Measure& measure) {
    const Point place_world = T_world_sensor.translation();
    require_reach(place_world, kMaxVoxelIndex,
                  "lies farther than 1e9 voxels from the origin of its coordinates");
    const VoxelIndex first =
        origin.value_or(config.origin.value_or(voxel_at(place_world, config.voxel_size)));
    const Point place = moved(place_world, VoxelIndex{} - first, config.voxel_size);
    require_reach(place, kFarthestVoxel, "lies farther than 5e8 voxels from the first");
    const std::vector<BlockIndex> around = blocks_to_clear(place);
    if (places.size() == places.capacity()) places.reserve(2 * places.size() + 1);
    Eigen::Isometry3d T_map_sensor = T_world_sensor;
    T_map_sensor.translation() = place;
    is_undoable = took_over = false;
    blocks.drop_kept();
    for (const BlockIndex& block : around)
      if (blocks.takes(block)) blocks.find_or_add(block);
    try {
      measure(T_map_sensor);
    } catch (...) {
      blocks.restore();
      throw;
    }
    places.push_back(place);
    origin = first;
    is_undoable = config.can_undo;
  }

  /// Throws InputError where what a sensor can see lies too far from a frame's zero.
  void require_reach(const Point& sensor, double most_voxels, const char* what) const {
    const double farthest = sensor.cwiseAbs().maxCoeff() + config.max_range + config.depth_behind;
    if (!(farthest < most_voxels * config.voxel_size))
      throw InputError("pose", what, "check its units and the voxel size");
  }

  std::vector<BlockIndex> blocks_to_clear(const Point& place) const {
    std::vector<BlockIndex> around;
    if (config.clear_radius <= 0.0) return around;
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(config.clear_radius);
    const BlockIndex low = block_of(voxel_at(place - reach, config.voxel_size));
    const BlockIndex high = block_of(voxel_at(place + reach, config.voxel_size));
    detail::require_room(blocks,
                         (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0));
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) around.push_back({x, y, z});
    return around;
  }
};

TsdfFusion::TsdfFusion(const FusionConfig& config) : state_(std::make_unique<State>()) {
  config.validate();
  state_->config = config;
  if (config.truncation == 0.0) state_->config.truncation = kDefaultTruncation * config.voxel_size;
  if (config.depth_behind == 0.0)
    state_->config.depth_behind =
        std::min(kDefaultDepth * config.voxel_size, state_->config.truncation);
  state_->blocks.keep_doubts(config.forget_after > 0);
}
TsdfFusion::~TsdfFusion() = default;
TsdfFusion::TsdfFusion(TsdfFusion&&) noexcept = default;
TsdfFusion& TsdfFusion::operator=(TsdfFusion&&) noexcept = default;

void TsdfFusion::integrate(const DepthImage& image, const PinholeCamera& camera,
                           const Eigen::Isometry3d& T_world_camera) {
  require_fits(image, camera);
  validate_transform(T_world_camera);
  State& s = *state_;
  s.visit(T_world_camera, [&](const Eigen::Isometry3d& T_map_camera) {
    const detail::DepthRanges ranges = detail::ranges_of(image, camera, s.config);
    const detail::DepthSurfaces surfaces(ranges.within, camera);
    if (s.config.integrator == Integrator::kProjective)
      detail::integrate_projective(surfaces, ranges, camera, T_map_camera, s.config, s.blocks);
    else
      detail::integrate_rays(points_of(surfaces, ranges.beyond, camera, T_map_camera),
                             T_map_camera.translation(), s.config, s.blocks);
  });
}

void TsdfFusion::integrate(std::span<const Point> points, const Eigen::Isometry3d& T_world_sensor) {
  validate_transform(T_world_sensor);
  State& s = *state_;
  s.visit(T_world_sensor, [&](const Eigen::Isometry3d& T_map_sensor) {
    std::vector<detail::SurfacePoint> kept;
    for (const Point& p : points) {
      const double range = p.norm();
      if (s.config.takes(range)) kept.push_back({T_map_sensor * p});
      if (!s.config.carve || !s.config.is_beyond(range)) continue;
      const double share = detail::as_far_as_it_counts(range, s.config) / range;
      kept.push_back({T_map_sensor * Point(share * p), Eigen::Vector3d::Zero(), true});
    }
    detail::integrate_rays(kept, T_map_sensor.translation(), s.config, s.blocks);
  });
}

TsdfMap TsdfFusion::map() const {
  const State& s = *state_;
  TsdfMap map;
  map.voxel_size = s.config.voxel_size;
  map.origin = s.origin.value_or(VoxelIndex{});
  map.truncation = s.config.truncation;
  s.blocks.copy_to(map);
  if (s.config.clear_radius > 0.0)
    for (const Point& place : s.places) clear_sphere(place, s.config.clear_radius, map);
  return map;
}

std::vector<VoxelChange> TsdfFusion::find_changes() {
  State& s = *state_;
  return s.accepted.find(s.blocks, s.origin.value_or(VoxelIndex{}), s.places, s.config);
}

void TsdfFusion::accept_changes() noexcept {
  State& s = *state_;
  s.blocks.drop_kept();
  s.accepted.accept(s.blocks);
  s.is_undoable = s.took_over = false;
}

void TsdfFusion::undo() noexcept {
  State& s = *state_;
  if (!std::exchange(s.is_undoable, false)) return;
  s.blocks.restore();
  if (std::exchange(s.took_over, false)) {
    s.places.swap(s.places_before);
    s.accepted.places_moved = false;
    return;
  }
  s.places.pop_back();
  if (s.places.empty()) s.origin.reset();
}

std::vector<BlockIndex> TsdfFusion::reached_blocks() const {
  std::vector<BlockIndex> reached;
  for (const std::uint32_t number : state_->blocks.touched())
    reached.push_back(state_->blocks.index(number));
  return reached;
}

TsdfFusion TsdfFusion::within_blocks(std::span<const BlockIndex> blocks) const {
  TsdfFusion part;
  State& s = *part.state_;
  s.config = state_->config;
  if (state_->origin) s.config.origin = state_->origin;
  if (!s.config.origin)
    throw InputError("origin", "is not known, as nothing was fused yet",
                     "fuse something first, or give FusionConfig::origin");
  s.config.can_undo = false;
  s.blocks.keep_doubts(s.config.forget_after > 0);
  s.only.insert(blocks.begin(), blocks.end());
  s.blocks.take_only(&s.only);
  return part;
}

void TsdfFusion::take_over(const TsdfFusion& part, std::span<const Point> places_world) {
  State& s = *state_;
  std::vector<Point> places;
  for (const Point& place : places_world)
    places.push_back(moved(place, VoxelIndex{} - *s.origin, s.config.voxel_size));
  for (const BlockIndex& block : part.state_->only) s.blocks.find_or_add(block);
  s.blocks.keep_touched();
  std::vector<std::pair<BlockIndex, detail::TsdfBlock>> all;  // before any is written over
  for (const BlockIndex& block : part.state_->only) {
    const detail::TsdfBlock* fused = part.state_->blocks.find(block);
    all.emplace_back(block, fused != nullptr ? *fused : s.blocks.fresh());
  }
  for (auto& [index, block] : all) s.blocks.write_over(index, std::move(block));
  s.places_before = std::exchange(s.places, std::move(places));
  s.accepted.places_moved = s.is_undoable = s.took_over = true;
}

OccupancyMap occupancy_of(const TsdfMap& tsdf) {
  OccupancyMap map;
  map.voxel_size = tsdf.voxel_size;
  map.origin = tsdf.origin;
  map.layout = tsdf.layout;
  map.state = VoxelField<VoxelState>(tsdf.layout);
  for (VoxelId id = 0; id < tsdf.layout.voxel_count(); ++id)
    if (tsdf.weight[id] > 0.0f)
      map.state[id] = tsdf.distance[id] > 0.0f ? VoxelState::kFree : VoxelState::kOccupied;
  detail::occupy_thin_surfaces(tsdf.distance, map);
  return normalised(std::move(map));
}

}  // namespace ridgeway
