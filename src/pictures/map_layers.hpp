// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <vector>

#include "canvas.hpp"
#include "floor_raster.hpp"
#include "picture_frame.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway {

/// Values at the ends of the diagram's colour ramp.
struct Range {
  double low = 0.0;
  double high = 0.0;
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

/// A diagram voxel with the value that gives its colour.
struct DiagramDot {
  Point centre;  ///< world
  double value = 0.0;
};

std::vector<DiagramDot> diagram_dots(const Roadmap& roadmap, DiagramColour colour);

/// From the 2nd to the 98th percentile, so that a few outliers do not take the colours.
Range middle_range(const std::vector<DiagramDot>& dots);

/// Free space, walls and unknown space.
void draw_raster(Canvas& canvas, const FloorRaster& raster, const MapFrame& frame);

void draw_diagram(Canvas& canvas, const std::vector<DiagramDot>& dots, const Range& range,
                  double voxel_size, const MapFrame& frame);

void draw_graph(Canvas& canvas, const Roadmap& roadmap, const MapFrame& frame);

}  // namespace ridgeway
