// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/build_roadmap.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "build_stages.hpp"
#include "common/number_text.hpp"
#include "common/require.hpp"
#include "esdf/widest_place.hpp"
#include "graph_of_curves.hpp"
#include "mapping/memory_limit.hpp"
#include "mapping/require_states.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/common/parallel.hpp"
#include "ridgeway/esdf/esdf.hpp"
#include "ridgeway/mapping/map_edits.hpp"
#include "ridgeway/mapping/occupancy_builder.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "skeleton/join_diagram.hpp"
#include "skeleton/level_peeling.hpp"
#include "voxel/mask_sets.hpp"

namespace ridgeway {
namespace {

using detail::require;

double ball_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

// What each stage takes of the whole configuration.

GraphConfig graph_config(const BuildConfig& config) {
  return {.min_clearance = config.min_clearance,
          .prune_radius = config.prune_radius,
          .split_deviation = config.split_deviation};
}

SimplifyConfig simplify_config(const BuildConfig& config) {
  return {.significance = config.significance};
}

TangentConfig tangent_config(const BuildConfig& config) {
  return {.tangent_pairs = config.tangent_pairs};
}

/// Of the stages that follow, which take so much for each of so many voxels.
void require_memory_for(std::size_t voxels, int bytes_each) {
  require_memory(static_cast<double>(voxels) * bytes_each, "map",
                 "use larger voxels, or cut the map down to a smaller box");
}

}  // namespace

void BuildConfig::validate() const {
  validate_policy(unknown);
  limits.validate();
  require(min_clearance > 0.0 && std::isfinite(min_clearance), "min_clearance", min_clearance,
          "give the robot's radius in metres, above 0");
  require(max_distance > min_clearance, "max_distance", max_distance,
          "give a length above min_clearance, or leave it out for no limit");
  detail::ridges_of(*this).validate();
  graph_config(*this).validate();
  simplify_config(*this).validate();
  tangent_config(*this).validate();
}

namespace detail {

GvdConfig ridges_of(const BuildConfig& config) {
  return {.theta = config.theta, .least_apart = config.least_apart};
}

void require_suits(const BuildConfig& config, double voxel_size) {
  validate_voxel_size(voxel_size, "voxel_size");
  require(config.min_clearance <= (kFarthestSite - 2) * voxel_size, "min_clearance",
          config.min_clearance, "give the robot's radius in metres, at most 15,998 voxels");
  require(config.min_clearance >= 1e-3 * voxel_size, "min_clearance", config.min_clearance,
          "give the robot's radius in metres, at least a thousandth of a voxel");
  // Up to two voxels below max_distance radii are exact; at least the smallest must be.
  constexpr double kRounding = 1.0 - 1e-9;
  require(config.max_distance >= (config.min_clearance + 2.0 * voxel_size) * kRounding,
          "max_distance", config.max_distance,
          "give at least min_clearance plus two voxels, or leave it out");
}

EsdfConfig distances_config(const BuildConfig& config) {
  return {config.unknown, config.max_distance, config.limits};
}

EsdfMap distances_of(OccupancyMap map, const BuildConfig& config) {
  if (config.unknown ==
      UnknownPolicy::kIgnore)  // where unknown space is solid, none is left anyway
    map = remove_pockets(std::move(map), ball_volume(config.min_clearance));
  return compute_esdf(std::move(map), distances_config(config));
}

void build_on_distances(VoxelMask traversable, const BuildConfig& config, BuildResult& result,
                        StageClock& clock, const Beside& beside) {
  const EsdfMap& esdf = result.roadmap.esdf;
  BuildReport& report = result.report;

  clock.begin("gvd");
  const GvdConfig ridges = ridges_of(config);
  VoxelMask gvd = compute_gvd(esdf, traversable, ridges);
  report.gvd_voxels = gvd.count();
  clock.end(report.seconds.gvd);

  clock.begin("edges");
  // In a plane ridges are curves already.
  VoxelMask thick_edges = esdf.planar                ? gvd
                          : config.basis_point_edges ? extract_basis_point_edges(esdf, gvd, ridges)
                                                     : extract_edges(esdf, gvd);
  gvd = {};  // what is not needed any more makes room
  report.edge_voxels = thick_edges.count();
  clock.end(report.seconds.edges);

  clock.begin("thin");
  VoxelMask edges = std::move(thick_edges);
  thin(esdf.layout, edges);
  clock.end(report.seconds.thin);

  clock.begin("kernel");
  Watershed watershed = find_watershed(esdf, traversable);
  clock.end(report.seconds.kernel);
  build_on_watershed([&] { return std::move(edges); },
                     [&] {
                       return Space{std::move(traversable), std::move(watershed)};
                     },
                     config, result, clock, nullptr, beside);
}

namespace {

/// What is left of traversable space when it is peeled, and the peaks that stay in it. Completes
/// the watershed by its passes.
struct Peeled {
  Basins basins;
  VoxelMask peaks, kernel;
};

Peeled peel(const RememberedSpace& space, Space parts, double min_clearance, BuildMemory* memory) {
  const EsdfMap& esdf = space.map();
  VoxelMask not_simple = std::move(parts.watershed.basins.not_simple_at_first_turn);
  Basins basins;
  parallel_for_each_index(2, [&](std::size_t task) {  // neither of which knows of the other
    if (task == 0)
      basins = find_passes(space, min_clearance, std::move(parts.watershed));
    else
      join_background(esdf, parts.traversable, not_simple);  // to have fewer voxels of it
  });
  VoxelMask peaks = significant_peaks(esdf, basins, parts.traversable);
  VoxelMask kernel = memory != nullptr
                         ? memory->peeling.peel(esdf, parts.traversable, not_simple, peaks,
                                                memory->rest ? &*memory->rest : nullptr)
                         : peel_levels(esdf, parts.traversable, std::move(not_simple), peaks);
  return {std::move(basins), std::move(peaks), std::move(kernel)};
}

void note_highest(const Basins& basins, BuildMemory& memory) {
  memory.is_highest.resize(basins.peaks.size());
  for (std::size_t basin = 0; basin < basins.peaks.size(); ++basin)
    if (basins.peaks[basin] != kNoVoxel)
      memory.is_highest[basin] = std::isinf(basins.dynamics[basin]);
}

/// The diagram, and the basins that it was joined by.
struct JoinedDiagram {
  Basins basins;
  VoxelMask diagram;
};

/// Peels traversable space down to the kernel, and joins it with the edges of ridges.
JoinedDiagram find_diagram(const RememberedSpace& space, const EdgesOf& edges_of,
                           const SpaceOf& space_of, const BuildConfig& config, BuildReport& report,
                           BuildMemory* memory) {
  const EsdfMap& esdf = space.map();
  VoxelMask edges;
  Peeled peeled;
  parallel_for_each_index(2, [&](std::size_t task) {
    if (task == 0) {
      edges = edges_of();
      space.remember_moves(edges);  // the kernel takes longer
    } else {
      peeled = peel(space, space_of(), config.min_clearance, memory);
    }
  });
  auto& [basins, peaks, kernel] = peeled;
  report.traversable_components = basins.components();
  report.kernel_voxels = memory == nullptr ? kernel.count() : memory->peeling.left_count();
  if (memory != nullptr) {
    note_highest(basins, *memory);
    if (memory->rest)
      for (VoxelMask* mask : {&kernel, &edges})
        *mask = common_members(*memory->rest->without, *mask);
  }
  require_memory_for(edges.count() + kernel.count(), kKernelBytesPerEdgeVoxel);
  open_shells(esdf, kernel, peaks);
  VoxelMask diagram = join_diagram(space, edges, kernel, config.min_clearance, basins,
                                   memory == nullptr ? nullptr : &memory->diagram);
  if (config.paper_diagram) diagram = std::move(edges);
  return {std::move(basins), std::move(diagram)};
}

}  // namespace

void build_on_watershed(const EdgesOf& edges_of, const SpaceOf& space_of, const BuildConfig& config,
                        BuildResult& result, StageClock& clock, BuildMemory* memory,
                        const Beside& beside) {
  Roadmap& roadmap = result.roadmap;
  const EsdfMap& esdf = roadmap.esdf;
  BuildReport& report = result.report;

  clock.start();
  SegmentMemory* const segments = memory == nullptr ? nullptr : &memory->segments;
  const RememberedSpace space(esdf, segments);
  JoinedDiagram found;
  parallel_for_each_index(beside ? 2 : 1, [&](std::size_t task) {
    if (task == 1) return beside();
    found = find_diagram(space, edges_of, space_of, config, report, memory);
  });
  Basins& basins = found.basins;
  VoxelMask& diagram = found.diagram;
  clock.end(report.seconds.kernel);

  clock.begin("graph");
  require_memory_for(diagram.count(), kGraphBytesPerDiagramVoxel);
  const DiagramCurves curves = index_diagram(esdf, diagram, config.min_clearance, segments);
  roadmap.graph = detail::build_graph(esdf, curves, graph_config(config), segments);
  if (config.simplify)
    roadmap.graph = detail::simplify_graph(esdf, roadmap.graph, simplify_config(config), segments);
  parallel_for_each_index(2, [&](std::size_t task) {
    if (task == 0)
      roadmap.tree = build_clearance_tree(esdf, roadmap.graph, basins);
    else
      roadmap.landmarks = place_landmarks(roadmap.graph);
  });
  report.graph_components = connected_components(roadmap.graph).count;
  clock.end(report.seconds.graph);

  clock.begin("attach");
  if (memory != nullptr) {
    memory->basin = std::move(basins.basin);
    memory->diagram.forget_changes();
  }
  roadmap.attach = detail::build_attach_field(esdf, curves, roadmap.graph, std::move(basins));
  roadmap.diagram.voxels = std::move(diagram);
  roadmap.diagram.complete = !config.paper_diagram;
  report.diagram_voxels = roadmap.diagram.voxels.count();
  clock.end(report.seconds.attach);
}

void build_what_is_learnt(const BuildConfig& config, BuildResult& result, StageClock& clock) {
  BuildReport& report = result.report;
  clock.begin("tangents");
  if (result.roadmap.cells.cells.empty())
    result.roadmap.cells = build_cell_graph(result.roadmap.esdf, config.min_clearance);
  result.roadmap.tangents = build_tangent_graph(result.roadmap, tangent_config(config));
  clock.end(report.seconds.tangents);

  report.seconds.total = report.seconds.sum();
}

}  // namespace detail

namespace {

/// Where no voxel is traversable.
[[noreturn]] void refuse_radius(const EsdfMap& esdf, double radius) {
  const auto widest = detail::widest_place(esdf);
  const auto metres = [](double length) { return number_text(std::floor(1e3 * length) / 1e3); };
  std::string what = "leaves no traversable voxel in this map";
  if (widest)
    what += ", whose widest place, " + metres(widest->place.x()) + "," + metres(widest->place.y()) +
            "," + metres(widest->place.z()) + ", has room for " + metres(widest->clearance);
  throw InputError("min_clearance " + number_text(radius), what,
                   std::string("give a smaller min_clearance") +
                       (has_flight_limits(esdf, esdf.limits)       ? ", or wider limits"
                        : esdf.unknown == UnknownPolicy::kObstacle ? ", or ignore the unknown"
                                                                   : ""));
}

/// Every stage, one after the other.
BuildResult build_by_stages(OccupancyMap map, const BuildConfig& config, const Progress& progress) {
  BuildResult result;
  BuildReport& report = result.report;
  Roadmap& roadmap = result.roadmap;
  detail::StageClock clock(progress);
  require_memory_for_blocks(map.layout.block_count(), kPipelineBytesPerVoxel - kMapBytesPerVoxel,
                            "map");  // of which there is only the map so far
  report.voxels = count_voxels(map);
  const bool may_be_free = config.unknown == UnknownPolicy::kFree && report.voxels.occupied > 0;
  if (report.voxels.free == 0 && !may_be_free)
    throw InputError("map", "has no free space",
                     "record free space, or give bounds where a cloud holds only surfaces");
  roadmap.min_clearance = config.min_clearance;

  clock.begin("esdf");
  roadmap.esdf = detail::distances_of(std::move(map), config);
  const EsdfMap& esdf = roadmap.esdf;
  require_room(esdf, esdf.limits);
  require_memory_for_blocks(esdf.layout.block_count(), kPipelineBytesPerVoxel - kEsdfBytesPerVoxel,
                            "map");  // it may have grown
  VoxelMask traversable = traversable_voxels(esdf, config.min_clearance);
  clock.end(report.seconds.esdf);
  report.allocated_voxels = esdf.layout.voxel_count();
  report.traversable_voxels = traversable.count();
  if (report.traversable_voxels == 0) refuse_radius(esdf, config.min_clearance);

  detail::build_on_distances(std::move(traversable), config, result, clock, [&] {
    roadmap.cells = build_cell_graph(roadmap.esdf, config.min_clearance);
  });
  detail::build_what_is_learnt(config, result, clock);
  if (progress && !progress("done", 1.0)) throw Cancelled();
  return result;
}

}  // namespace

BuildResult build_roadmap(OccupancyMap map, const BuildConfig& config, const Progress& progress) {
  config.validate();
  detail::require_suits(config, map.voxel_size);
  detail::require_states(map);
  return with_progress(progress, "esdf", [&](const Progress& report) {
    return build_by_stages(std::move(map), config, report);
  });
}

}  // namespace ridgeway
