// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <string>

#include "ridge_container.hpp"
#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// A graph that is built has about two edges a vertex; a file may not have more than this.
inline constexpr std::uint64_t kMostEdgesPerVertex = 64;

/// The numbers that say how a roadmap's sections are to be read; JSON text in the file.
struct RidgeHeader {
  double voxel_size = 0.0;
  VoxelIndex origin;
  UnknownPolicy unknown = UnknownPolicy::kObstacle;
  double max_distance = 0.0;
  FlightLimits limits;  ///< local frame
  bool planar = false;
  double min_clearance = 0.0;
  double graph_min_clearance = 0.0;
  bool complete_diagram = true;
  std::string source;
  std::string config;
  std::uint32_t blocks = 0;
  std::uint32_t vertices = 0;
  std::uint32_t edges = 0;
  std::uint32_t corners = 0;        ///< of the tangent graph, and its edges
  std::uint32_t tangent_edges = 0;  ///< `taut_edges` in the file
};

RidgeHeader header_of(const Roadmap& roadmap);
std::string header_text(const RidgeHeader& header);
/// Throws InputError for text that is no header of a roadmap or has a value out of range.
RidgeHeader parse_header(const RidgeReader& reader);

}  // namespace ridgeway
