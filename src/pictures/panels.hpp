// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <string>
#include <vector>

#include "floor_raster.hpp"
#include "picture_frame.hpp"
#include "ridgeway/pictures/picture.hpp"

namespace ridgeway {

/// One view of a map: the plan, a storey, a side, a section.
struct Panel {
  FloorRaster raster;
  HeightBand range;     ///< of what is drawn over it, along the line of sight
  std::string caption;  ///< empty where there is but one
  MapFrame frame;       ///< where it lies; set by lay_out_panels
};

/// The views that are asked for, the plan first.
std::vector<Panel> make_panels(const Roadmap& roadmap, const PictureConfig& config);

/// Which heights the walls of a plan are from, in words.
std::string heights_text(const EsdfMap& esdf, const FloorRaster& raster);

/// Puts panels one below the other, all at one scale, in a column `width` wide, `top` from the
/// page's top (pixels). Returns where the last one ends, its axis included.
double lay_out_panels(std::vector<Panel>& panels, double voxel_size, double left, double top,
                      double width, double unit);

}  // namespace ridgeway
