// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/roadmap/components.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/name_table.hpp"
#include "common/require.hpp"
#include "ridgeway/skeleton/basins.hpp"
#include "ridgeway/skeleton/gvd.hpp"
#include "voxel/disjoint_sets.hpp"

namespace ridgeway {
namespace {

constexpr std::size_t kNoComponent = static_cast<std::size_t>(-1);
constexpr double kSmallest = 0.25;  // radius, voxels, at which any free voxel is traversable

/// Sets of basins as the level sinks through the passes, widest first.
class SinkingLevel {
 public:
  explicit SinkingLevel(const Basins& basins) : basins_(basins), sets_(basins.peaks.size()) {}

  std::uint32_t set_of(VoxelId id) { return sets_.find(basins_.basin[id]); }

  /// Joins over all passes at or above a level.
  void sink_to(SquaredHalves level) {
    for (; next_ < basins_.passes.size() && basins_.passes[next_].clearance >= level; ++next_)
      sets_.join(set_of(basins_.passes[next_].from), set_of(basins_.passes[next_].to));
  }
  const Pass* next_pass() const {
    return next_ < basins_.passes.size() ? &basins_.passes[next_] : nullptr;
  }
  std::uint32_t join_next() {
    const Pass& pass = basins_.passes[next_++];
    return sets_.join(set_of(pass.from), set_of(pass.to));
  }

 private:
  const Basins& basins_;
  DisjointSets sets_;
  std::size_t next_ = 0;
};

Point centre_in_world(const EsdfMap& esdf, VoxelId id) {
  return to_world(esdf, centre_of(esdf.layout.index_of(id), esdf.voxel_size));
}

/// Components by set, largest first; fills `component_of` a set.
std::vector<Component> count_components(const EsdfMap& esdf, const VoxelMask& traversable,
                                        SinkingLevel& level,
                                        std::vector<std::size_t>& component_of) {
  std::vector<std::size_t> voxels(component_of.size(), 0);
  std::vector<VoxelId> widest(component_of.size(), kNoVoxel);
  for (const VoxelId id : traversable.members(esdf.layout)) {
    const std::uint32_t set = level.set_of(id);
    ++voxels[set];
    if (widest[set] == kNoVoxel || esdf.squared[id] > esdf.squared[widest[set]]) widest[set] = id;
  }
  std::vector<std::size_t> sets;
  for (std::size_t set = 0; set < voxels.size(); ++set)
    if (voxels[set] > 0) sets.push_back(set);
  std::stable_sort(sets.begin(), sets.end(),
                   [&](std::size_t a, std::size_t b) { return voxels[a] > voxels[b]; });
  std::vector<Component> components;
  for (const std::size_t set : sets) {
    component_of[set] = components.size();
    components.push_back({voxels[set],
                          static_cast<double>(voxels[set]) * std::pow(esdf.voxel_size, 3),
                          centre_in_world(esdf, widest[set]), esdf.distance(widest[set])});
  }
  return components;
}

/// Space as it falls into parts at a radius.
struct Parts {
  SinkingLevel level;
  std::vector<std::size_t> component_of;  // by set
  ComponentReport report;                 // without joins
};
Parts parts_at(const EsdfMap& esdf, const Basins& basins, bool within_limits, double radius,
               const std::vector<VoxelId>& asked) {
  detail::require(radius > 0.0 && std::isfinite(radius), "radius", radius,
                  "give the robot's radius in metres, above 0");
  Parts parts{SinkingLevel(basins), std::vector(basins.peaks.size(), kNoComponent), {}};
  parts.level.sink_to(least_clearance(radius, esdf.voxel_size));
  parts.report.components = count_components(esdf, traversable_voxels(esdf, radius, within_limits),
                                             parts.level, parts.component_of);
  for (const VoxelId id : asked)
    parts.report.asked.push_back(parts.component_of[parts.level.set_of(id)]);
  return parts;
}

}  // namespace

std::string_view name_of(Blocker blocker) {
  constexpr std::array<std::string_view, 3> kNames{"obstacle", "unknown", "limits"};
  return name_in(kNames, blocker);
}

SpaceParts::SpaceParts(const EsdfMap& esdf, bool within_limits)
    : esdf_(esdf),
      within_limits_(within_limits),
      around_(esdf),
      basins_(find_basins(esdf,
                          traversable_voxels(esdf, kSmallest * esdf.voxel_size, within_limits),
                          kSmallest * esdf.voxel_size)) {}

ComponentReport SpaceParts::parts(double radius, const std::vector<VoxelId>& asked) const {
  return parts_at(esdf_, basins_, within_limits_, radius, asked).report;
}

ComponentReport SpaceParts::report(double radius, const std::vector<VoxelId>& asked) const {
  auto [level, component_of, report] = parts_at(esdf_, basins_, within_limits_, radius, asked);
  while (const Pass* pass = level.next_pass()) {
    const std::size_t a = component_of[level.set_of(pass->from)];
    const std::size_t b = component_of[level.set_of(pass->to)];
    if (a != kNoComponent && b != kNoComponent && a != b) {
      const Narrow narrow = look_at(*pass);
      report.joins.push_back({std::min(a, b), std::max(a, b),
                              pass->clearance.metres(esdf_.voxel_size), narrow.place, narrow.by});
    }
    component_of[level.join_next()] = std::min(a, b);  // kNoComponent is the largest
  }
  return report;
}

std::optional<Pass> SpaceParts::narrowest_move(VoxelId a, VoxelId b) const {
  if (a == b) return std::nullopt;
  // Each voxel climbs to its peak without a dip, so its own place is the narrowest up there.
  const VoxelId lower = esdf_.squared[a] <= esdf_.squared[b] ? a : b;
  const Pass own{esdf_.squared[lower], lower, lower};
  SinkingLevel level(basins_);
  std::optional<Pass> narrowest = own;
  while (level.set_of(a) != level.set_of(b)) {
    const Pass* pass = level.next_pass();
    if (pass == nullptr) return std::nullopt;
    narrowest = pass->clearance < own.clearance ? *pass : own;
    level.join_next();
  }
  return narrowest;
}

SpaceParts::Narrow SpaceParts::look_at(const Pass& pass) const {
  VoxelId from = pass.from, to = pass.to;
  const VoxelId lower = esdf_.squared[from] <= esdf_.squared[to] ? from : to;
  if (esdf_.squared[lower] <= pass.clearance) from = to = lower;  // else it dips on the way
  const std::array<Point, 2> move{centre_in_world(esdf_, from), centre_in_world(esdf_, to)};
  const Point place = 0.5 * (move[0] + move[1]);
  if (esdf_.unknown != UnknownPolicy::kObstacle) return {place, Blocker::kObstacle};
  // Of a radius that is large enough nothing more is asked than what is nearest.
  const PathSurroundings around = around_.along(move, pass.clearance.metres(esdf_.voxel_size));
  const bool is_known = around.known <= around.unknown * (1.0 + 1e-9);
  return {place, is_known ? Blocker::kObstacle : Blocker::kUnknown};
}

ComponentReport report_components(const Roadmap& roadmap) {
  return SpaceParts(roadmap.esdf).report(roadmap.min_clearance);
}

}  // namespace ridgeway
