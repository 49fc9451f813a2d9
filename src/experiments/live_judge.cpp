// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "live_judge.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "ridgeway/common/error.hpp"
#include "ridgeway/skeleton/diagram.hpp"
#include "ridgeway/skeleton/gvd.hpp"

namespace ridgeway {

/// What each stage makes of a field, as masks on its layout.
struct LiveJudge::Stages {
  VoxelMask traversable, gvd, thick_edges, edges, kernel, diagram;

  Stages() = default;
  explicit Stages(const Roadmap& roadmap);
};

LiveJudge::Stages::Stages(const Roadmap& roadmap) {
  const EsdfMap& esdf = roadmap.esdf;

  traversable = traversable_voxels(esdf, roadmap.min_clearance);
  gvd = compute_gvd(esdf, traversable);
  thick_edges = extract_edges(esdf, gvd);
  edges = thick_edges;
  thin(esdf.layout, edges);
  const Basins basins = find_basins(esdf, traversable, roadmap.min_clearance);
  kernel = compute_kernel(esdf, traversable, basins);
  diagram = roadmap.diagram.voxels;
}

namespace {

/// `before` is of a layout to which blocks were added since.
StageChange change_of(const VoxelMask& before, const VoxelMask& now) {
  StageChange change;
  for (std::uint32_t slot = 0; slot < now.block_count(); ++slot) {
    std::size_t changed = 0;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      const std::uint64_t old = slot < before.block_count() ? before.block(slot)[z] : 0;
      change.voxels += static_cast<std::size_t>(std::popcount(now.block(slot)[z]));
      changed += static_cast<std::size_t>(std::popcount(old ^ now.block(slot)[z]));
    }
    change.changed += changed;
    change.blocks += changed > 0;
  }
  return change;
}

}  // namespace

bool is_same(const Roadmap& a, const Roadmap& b) {
  const auto same_vertex = [](const Vertex& v, const Vertex& w) {
    return v.voxel == w.voxel && v.clearance == w.clearance;
  };
  const auto same_edge = [](const Edge& e, const Edge& f) {
    return e.from == f.from && e.to == f.to && e.length == f.length && e.clearance == f.clearance;
  };
  if (!std::ranges::equal(a.graph.vertices, b.graph.vertices, same_vertex) ||
      !std::ranges::equal(a.graph.edges, b.graph.edges, same_edge) ||
      a.tree.parent != b.tree.parent || a.tree.clearance != b.tree.clearance)
    return false;
  for (VoxelId id = 0; id < a.esdf.layout.voxel_count(); ++id) {
    const VoxelId same = b.esdf.layout.find(a.esdf.layout.index_of(id));
    if (same == kNoVoxel || a.esdf.squared[id] != b.esdf.squared[same] ||
        a.esdf.site[id] != b.esdf.site[same] || a.esdf.state[id] != b.esdf.state[same] ||
        a.diagram.voxels.test(id) != b.diagram.voxels.test(same) ||
        a.attach.next[id] != b.attach.next[same])
      return false;
  }
  return a.esdf.layout.block_count() == b.esdf.layout.block_count();
}

namespace {

bool can_be_built(const OccupancyMap& map, const BuildConfig& build) {
  try {
    build_roadmap(map, build);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

LiveJudge::LiveJudge(const BuildConfig& build, std::size_t every)
    : build_(build), every_(every), before_(std::make_unique<Stages>()) {}
LiveJudge::~LiveJudge() = default;

LiveScan LiveJudge::judge(const LiveRoadmap& live, const UpdateReport& update) {
  LiveScan scan;
  scan.update = update;
  const std::shared_ptr<const Roadmap> now = live.snapshot();
  if (every_ == 0 || ++updates_ % every_ != 0) return scan;
  const OccupancyMap map = live.map();
  if (now == nullptr) {
    scan.is_same = !can_be_built(map, build_);
    return scan;
  }
  scan.known_voxels = count_voxels(map).known();
  scan.map_blocks = map.layout.block_count();
  const BuildResult batch = build_roadmap(map, build_);
  scan.batch = batch.report.seconds;
  scan.is_same = is_same(*now, batch.roadmap);
  scan.is_judged = true;
  Stages stages(*now);
  for (auto [change, mask] : {std::pair(&LiveScan::traversable, &Stages::traversable),
                              {&LiveScan::gvd, &Stages::gvd},
                              {&LiveScan::thick_edges, &Stages::thick_edges},
                              {&LiveScan::edges, &Stages::edges},
                              {&LiveScan::kernel, &Stages::kernel},
                              {&LiveScan::diagram, &Stages::diagram}})
    scan.*change = change_of((*before_).*mask, stages.*mask);
  *before_ = std::move(stages);
  return scan;
}

}  // namespace ridgeway
