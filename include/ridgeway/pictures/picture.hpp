// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ridgeway/roadmap/roadmap.hpp"

namespace ridgeway {

/// What the colours of the diagram's voxels say.
enum class DiagramColour : std::uint8_t {
  kClearance,
  kHeight,
  kComponent,  ///< what a robot of the smallest radius can get to from each other; of the graph too
};

/// Heights in the world that count for the plan's walls and free space, metres; low <= high.
struct HeightBand {
  double low = 0.0;   ///< from here
  double high = 0.0;  ///< to here
};

/// A quantity over time, drawn below the map.
struct Chart {
  std::string label;                           ///< with its unit
  std::vector<double> times;                   ///< seconds from 0, ascending
  std::vector<double> values;                  ///< one a time, >= 0; gaps where not finite
  std::optional<double> limit = std::nullopt;  ///< a dashed line
  std::string limit_label;                     ///< what is written beside it
};

/// One of several paths of a picture.
struct NamedPath {
  std::string name;              ///< in the legend, before the path's length
  std::vector<Point> waypoints;  ///< metres, world
};

/// What a picture of a map shows.
struct PictureConfig {
  int width = 1600;  ///< pixels, 400 to 16000; the height follows the map, up to 1.5 widths, or 3
                     ///< for several views
  /// Not given: between the 20th and the 80th percentile of the free voxels' heights, so that
  /// floor and ceiling do not hide the rooms.
  std::optional<HeightBand> band;
  /// A plan for each storey of a building, from below, in place of one; `band` does not count.
  bool floors = false;
  /// Below the plan the map from the front (x and z) and from a side (y and z), seen through.
  bool sides = false;
  /// Below the plan a section, a voxel thick, at this y (x and z are drawn), in place of the map
  /// seen through; metres.
  std::optional<double> section_y = std::nullopt;
  /// The same at this x (y and z are drawn); metres.
  std::optional<double> section_x = std::nullopt;
  bool diagram = true;  ///< the voxels of the diagram
  bool graph = true;    ///< vertices and edges
  /// Rings where connected components would be one for a smaller robot, with the radius that fits.
  bool narrow_places = false;
  DiagramColour diagram_colour = DiagramColour::kClearance;  ///< what its colours say
  std::string title;                ///< not given: the file name of the roadmap's source
  std::vector<Point> raw_path;      ///< the path before it was shortened, dashed; may be empty
  std::string path_label = "path";  ///< in the legend, before the length
  std::string raw_path_label = "before shortening";  ///< in the legend, before the length
  std::vector<NamedPath> paths;  ///< to compare, at most eight, each in its colour; none red
  std::vector<Chart> charts;     ///< below the map, one after another

  /// Throws InputError naming the bad field.
  void validate() const;
};

/// Draws the map from above in the world frame, as the paths are in, x to the right and y up, as a
/// PNG or SVG picture by the extension of `out`: known free space white, obstacles dark by the
/// occupied share of each column within the height band, unknown pale, boxes that nobody may fly
/// through hatched; over it the skeleton diagram, the graph, the paths to compare, and the path
/// (may be empty); start and goal of the path, without one of the first of the others. Storeys and
/// views from the sides, where they are asked for, at the same scale below it. With title,
/// coordinates, scale bar, legend and charts. A map of any extent: the picture's cells cover
/// several voxels where there are more voxels than pixels. Throws InputError for a map without
/// known voxels, another extension, a file that cannot be written. The file is replaced whole or
/// not at all.
void draw_floor_plan(const Roadmap& roadmap, std::span<const Point> path,
                     const std::filesystem::path& out, const PictureConfig& config = {});

/// One of the maps of a sheet and the line of text above it.
struct SheetMap {
  const Roadmap* roadmap = nullptr;  ///< must live while the sheet is drawn
  std::string caption;               ///< above it
};

/// Draws maps side by side, `columns` in a row, as floor plans with diagram and graph, all at the
/// scale of the widest; PNG or SVG. Throws InputError like draw_floor_plan.
void draw_map_sheet(std::span<const SheetMap> maps, int columns, const std::string& title,
                    const std::filesystem::path& out, const PictureConfig& config = {});

}  // namespace ridgeway
