// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "canvas.hpp"
#include "floor_raster.hpp"
#include "picture_frame.hpp"
#include "ridgeway/pictures/picture.hpp"
#include "ridgeway/roadmap/components.hpp"

namespace ridgeway {

/// Values at the ends of the diagram's colour ramp.
struct Range {
  double low = 0.0;
  double high = 0.0;
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

/// A diagram voxel with the value that gives its colour.
struct DiagramDot {
  Point centre;        ///< world
  double value = 0.0;  ///< metres, or the number of its component
};

/// What is drawn over the map, with what gives its colours.
struct MapMarks {
  std::vector<DiagramDot> dots;
  Range range;                           ///< of the dots' values
  std::vector<std::size_t> of_vertices;  ///< their components; empty: the graph has one colour
  std::vector<ComponentJoin> narrow;     ///< widest first
  FlightLimits limits;                   ///< world
  bool by_component() const { return !of_vertices.empty(); }
};

MapMarks marks_of(const Roadmap& roadmap, const PictureConfig& config);

/// Free space, walls and unknown space.
void draw_raster(Canvas& canvas, const FloorRaster& raster, const MapFrame& frame);

/// The diagram and, if asked for, the graph, as far as they lie within the frame: where unknown
/// space is free they go on beyond what is known.
void draw_skeleton(Canvas& canvas, const Roadmap& roadmap, const MapMarks& marks, bool graph,
                   const MapFrame& frame);

/// Boxes that nobody may fly through, and the border of the one that flights stay in.
void draw_limits(Canvas& canvas, const FlightLimits& limits, const MapFrame& frame);

/// Rings of the size of what they let through, and that radius, where there is room for it.
void draw_narrow_places(Canvas& canvas, const MapMarks& marks, const MapFrame& frame);

}  // namespace ridgeway
