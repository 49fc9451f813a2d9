// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "common/clock.hpp"
#include "common/number_text.hpp"
#include "common/random.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/free_space.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/planning/plan.hpp"
#include "ridgeway/skeleton/basins.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

using detail::seconds_now;

struct Ends {
  Point start, goal;
};

/// Traversable voxels of the largest component: those whose basins hang together there.
VoxelMask main_component(const Roadmap& roadmap, const Basins& basins) {
  DisjointSets parts(basins.peaks.size());
  for (const Pass& pass : basins.passes) parts.join(basins.basin[pass.from], basins.basin[pass.to]);
  std::vector<std::size_t> voxels(basins.peaks.size(), 0);
  const BlockLayout& layout = roadmap.esdf.layout;
  const auto part_of = [&](VoxelId id) { return parts.find(basins.basin[id]); };
  for (VoxelId id = 0; id < layout.voxel_count(); ++id)
    if (basins.next[id] != kNotTraversable) ++voxels[part_of(id)];
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(voxels.begin(), voxels.end()) - voxels.begin());
  VoxelMask mask(layout);
  for (VoxelId id = 0; id < layout.voxel_count(); ++id)
    if (basins.next[id] != kNotTraversable && part_of(id) == largest) mask.set(id);
  return mask;
}

VoxelMask main_component(const Roadmap& roadmap) {
  const VoxelMask traversable = traversable_voxels(roadmap.esdf, roadmap.min_clearance);
  return main_component(roadmap, find_basins(roadmap.esdf, traversable, roadmap.min_clearance));
}

/// Scans of the world, fused; the median time of a scan in milliseconds.
OccupancyMap scan(const World& world, const std::vector<Eigen::Isometry3d>& poses,
                  const NoiseConfig& config, double voxel_size, double sigma,
                  double& milliseconds) {
  DepthSensor sensor;
  sensor.range_sigma = sigma;
  TsdfFusion fusion(
      {.voxel_size = voxel_size, .truncation = std::max(config.truncation, voxel_size)});
  std::vector<double> times;
  Random seeds(config.seed);
  for (const Eigen::Isometry3d& pose : poses) {
    const DepthImage image = render_depth(world, sensor, pose, seeds.bits());
    const double begin = seconds_now();
    fusion.integrate(image, sensor.camera, pose);
    times.push_back(1e3 * (seconds_now() - begin));
  }
  milliseconds = spread_of(std::move(times)).median;
  return remove_isolated(occupancy_of(fusion.map()), config.isolated_below);
}

Box box_of(const PoseSampling& inside) { return {inside.low, inside.high}; }

NoiseMap make_map(const World& world, const std::vector<Eigen::Isometry3d>& poses,
                  const NoiseConfig& config, double voxel_size, std::optional<double> sigma) {
  NoiseMap map;
  map.voxel_size = voxel_size;
  map.sigma = sigma;
  OccupancyMap voxels = sigma
                            ? scan(world, poses, config, voxel_size, *sigma, map.scan_milliseconds)
                            : occupancy_of(world, voxel_size, box_of(sampling_inside(world)));
  map.built = build_roadmap(std::move(voxels), {.min_clearance = config.min_clearance,
                                                .unknown = UnknownPolicy::kIgnore});
  map.check = check_roadmap(map.built.roadmap, {config.queries, config.seed});
  const SparseGraph& graph = map.built.roadmap.graph;
  map.cycles = graph.edges.size() + map.built.report.graph_components - graph.vertices.size();
  return map;
}

/// Random starts and goals that every map can be asked for.
std::vector<Ends> common_pairs(const World& world, const NoiseConfig& config,
                               const std::vector<NoiseMap>& maps) {
  std::vector<VoxelMask> main;
  main.reserve(maps.size());
  for (const NoiseMap& map : maps) main.push_back(main_component(map.built.roadmap));
  const auto is_common = [&](const Point& p) {
    const double distance = surface_distance(world, p).distance;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      if (distance < config.min_clearance + maps[i].voxel_size) return false;
      const EsdfMap& esdf = maps[i].built.roadmap.esdf;
      const Point p_local = to_local(esdf, p);
      const VoxelId id = esdf.layout.find(voxel_at(p_local, maps[i].voxel_size));
      if (id == kNoVoxel || !main[i].test(id)) return false;
      if (!FreeSpace(esdf).is_free(p_local, config.min_clearance)) return false;
    }
    return true;
  };
  const PoseSampling inside = sampling_inside(world);
  Random random(config.seed + 1);
  std::vector<Point> places;
  const std::size_t most_tries = 10000 + 200 * config.pairs;
  for (std::size_t i = 0; i < most_tries && places.size() < 2 * config.pairs; ++i) {
    Point p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = random.uniform(inside.low[axis], inside.high[axis]);
    if (is_common(p)) places.push_back(p);
  }
  std::vector<Ends> pairs;
  for (std::size_t i = 0; i + 1 < places.size(); i += 2)
    pairs.push_back({places[i], places[i + 1]});
  return pairs;
}

/// Lengths of the routes; infinite where there is none.
std::vector<double> route_lengths(const Roadmap& roadmap, const std::vector<Ends>& pairs,
                                  Planner planner) {
  std::vector<double> lengths(pairs.size(), std::numeric_limits<double>::infinity());
  parallel_for_each_index(pairs.size(), [&](std::size_t i) {
    const PlanResult result = plan(roadmap, pairs[i].start, pairs[i].goal, {.planner = planner});
    if (result.ok()) lengths[i] = result.length;
  });
  return lengths;
}

/// How the maps' routes compare with the best of the first map.
void compare_routes(const std::vector<Ends>& pairs, NoiseResult& result, const Progress& progress) {
  const Roadmap& reference = result.maps.front().built.roadmap;
  std::vector<double> best = route_lengths(reference, pairs, Planner::kEsdf);
  const std::vector<double> own = route_lengths(reference, pairs, Planner::kGraph);
  for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::min(best[i], own[i]);
  for (NoiseMap& map : result.maps) {
    if (progress && !progress("routes", 0.9)) throw Cancelled();
    const std::vector<double> lengths = route_lengths(map.built.roadmap, pairs, Planner::kGraph);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < lengths.size(); ++i)
      if (std::isfinite(lengths[i])) ratios.push_back(lengths[i] / best[i]);
    map.solved = ratios.size();
    map.length_ratio = spread_of(std::move(ratios));
  }
}

double size_ratio_of(const std::vector<NoiseMap>& maps) {
  std::size_t least = std::numeric_limits<std::size_t>::max(), most = 0;
  for (const NoiseMap& map : maps) {
    const SparseGraph& graph = map.built.roadmap.graph;
    least = std::min(least, graph.vertices.size() + graph.edges.size());
    most = std::max(most, graph.vertices.size() + graph.edges.size());
  }
  return static_cast<double>(most) / static_cast<double>(least);
}

}  // namespace

void NoiseConfig::validate() const {
  if (voxel_sizes.empty()) throw InputError("voxel_sizes", "is empty", "give at least one");
  for (const double sigma : sigmas)
    if (!(sigma >= 0.0 && std::isfinite(sigma)))
      throw InputError("sigmas", "holds " + number_text(sigma), "give metres, 0 or more");
  poses.validate();
}

NoiseResult run_noise(const World& world, const NoiseConfig& config, const Progress& progress) {
  NoiseResult result;
  run_noise(world, config, progress, result);
  return result;
}

void run_noise(const World& world, const NoiseConfig& config, const Progress& progress,
               NoiseResult& result) {
  config.validate();
  const std::vector<Eigen::Isometry3d> poses = sample_poses(world, config.poses);
  result = {};
  const std::size_t count = config.voxel_sizes.size() * (1 + config.sigmas.size());
  const auto add = [&](double voxel_size, std::optional<double> sigma) {
    const auto done = static_cast<double>(result.maps.size()) / static_cast<double>(count);
    if (progress && !progress("maps", 0.9 * done)) throw Cancelled();
    result.maps.push_back(make_map(world, poses, config, voxel_size, sigma));
  };
  for (const double voxel_size : config.voxel_sizes) {
    add(voxel_size, std::nullopt);
    for (const double sigma : config.sigmas) add(voxel_size, sigma);
  }
  const std::vector<Ends> pairs = common_pairs(world, config, result.maps);
  result.pairs = pairs.size();
  compare_routes(pairs, result, progress);
  result.size_ratio = size_ratio_of(result.maps);
}

}  // namespace ridgeway
