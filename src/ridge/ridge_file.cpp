// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/ridge/ridge_file.hpp"

#include "ridge_checks.hpp"
#include "ridge_container.hpp"
#include "ridge_header.hpp"
#include "ridge_sections.hpp"
#include "ridgeway/common/error.hpp"
#include "roadmap/bounded_hub_labels.hpp"

namespace ridgeway {

namespace {

/// Whether programs that know of no limits, planes and free unknown space would read it wrongly.
bool needs_newest(const EsdfMap& esdf) {
  return esdf.limits.any() || esdf.planar || esdf.unknown == UnknownPolicy::kFree;
}

}  // namespace

void save_roadmap(const Roadmap& roadmap, const std::filesystem::path& path) {
  auto defect = find_size_defect(roadmap);
  if (!defect) defect = find_graph_defect(roadmap);
  if (!defect) defect = find_tangent_defect(roadmap);
  if (!defect) defect = find_attach_defect(roadmap);
  if (!defect) defect = find_planar_defect(roadmap);
  if (defect) {
    throw InputError("roadmap", "part '" + defect->part + "' " + defect->what,
                     "save what build_roadmap returned");
  }
  std::vector<RidgeSectionSource> sections = list_sections(roadmap);
  for (RidgeSectionSource& section : voxel_sections(roadmap)) {
    sections.push_back(std::move(section));
  }
  write_ridge_container(path, header_text(header_of(roadmap)), sections,
                        needs_newest(roadmap.esdf) ? kRidgeVersion : kRidgeVersionWithoutLimits);
}

Roadmap load_roadmap(const std::filesystem::path& path) {
  const RidgeReader reader(path);
  const RidgeHeader header = parse_header(reader);
  check_memory(reader, header);
  Roadmap roadmap;
  roadmap.min_clearance = header.min_clearance;
  roadmap.graph.min_clearance = header.graph_min_clearance;
  roadmap.diagram.complete = header.complete_diagram;
  roadmap.source = header.source;
  roadmap.config = header.config;
  roadmap.esdf.voxel_size = header.voxel_size;
  roadmap.esdf.origin = header.origin;
  roadmap.esdf.unknown = header.unknown;
  roadmap.esdf.limits = header.limits;
  roadmap.esdf.planar = header.planar;
  roadmap.esdf.max_distance = header.max_distance;
  roadmap.esdf.layout = load_blocks(reader, header.blocks);
  load_voxels(reader, header, roadmap);
  load_graph(reader, header, roadmap);

  auto defect = find_size_defect(roadmap);
  if (!defect) defect = find_site_defect(roadmap);
  if (!defect) defect = find_graph_defect(roadmap);
  if (!defect) defect = find_tangent_defect(roadmap);
  if (!defect) defect = find_attach_defect(roadmap);
  if (!defect) defect = find_planar_defect(roadmap);
  if (!defect) defect = find_unattached_defect(roadmap);
  if (defect) reader.damaged(defect->part, defect->what);
  index_links(roadmap.graph);
  roadmap.landmarks = place_landmarks(roadmap.graph);
  roadmap.cells = build_cell_graph(roadmap.esdf, roadmap.min_clearance);
  if (TangentGraph& tangents = roadmap.tangents; !tangents.graph.vertices.empty()) {
    index_links(tangents.graph);
    auto hubs = detail::label_hubs_within(tangents.graph);
    if (!hubs) reader.damaged("taut_edges", "has too many shortest ways");
    tangents.hubs = *std::move(hubs);
  }
  return roadmap;
}

RidgeInfo read_ridge_info(const std::filesystem::path& path) {
  const RidgeReader reader(path);
  RidgeInfo info{reader.version(), reader.header(), {}};
  for (const RidgeSectionEntry& section : reader.sections()) {
    info.sections.push_back({section.name, section.raw_bytes, section.compressed_bytes});
  }
  return info;
}

}  // namespace ridgeway
